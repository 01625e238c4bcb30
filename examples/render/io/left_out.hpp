#pragma once

#include <string>
#include <vector>

namespace render {

/// Something that a scene's files carry and its picture does not show as it is written there.
struct LeftOut {
    std::string what;
    std::string why;

    bool operator==(const LeftOut&) const = default;
};

/// Appends to `all`, unless the same is there already.
inline void leave_out(std::vector<LeftOut>& all, std::string what, std::string why) {
    LeftOut item{std::move(what), std::move(why)};
    for (const LeftOut& other : all) {
        if (other == item) return;
    }
    all.push_back(std::move(item));
}

}  // namespace render
