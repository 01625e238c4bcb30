#include "io/printable.hpp"

namespace render {

std::string printable(std::string_view text, std::size_t most) {
    constexpr char digits[] = "0123456789abcdef";
    std::string shown;
    for (const char c : text.substr(0, most)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 32 && byte != 127) {
            shown += c;
        } else {
            shown += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
        }
    }
    return text.size() > most ? shown + "..." : shown;
}

}  // namespace render
