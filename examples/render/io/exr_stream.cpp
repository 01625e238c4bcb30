#include "io/exr_stream.hpp"

#include <cstddef>
#include <cstring>

#include <IexBaseExc.h>

namespace render {

bool ExrStream::read(char to[], int count) {
    const std::uint64_t left = at_ < bytes_.size() ? bytes_.size() - at_ : 0;
    if (count < 0 || static_cast<std::uint64_t>(count) > left) {
        ran_out_ = true;
        throw Iex::InputExc("Unexpected end of file.");
    }
    if (count > 0) std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
}

}  // namespace render
