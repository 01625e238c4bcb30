#include "io/left_out.hpp"

#include <utility>

namespace render {

void LeftOutList::add(std::string what, std::string why) {
    Group& group = groups_[why];
    if (!group.known.insert(what).second) return;
    if (group.named < most_named) {
        ++group.named;
        group.last = items_.size();
        group.last_name = what;
        items_.push_back({std::move(what), std::move(why)});
        return;
    }
    ++group.unnamed;
    items_[group.last].what = group.last_name + ", and " + std::to_string(group.unnamed) + " more";
}

}  // namespace render
