#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace render {

/// Something that a scene's files carry and its picture does not show as it is written there.
struct LeftOut {
    std::string what;
    std::string why;

    bool operator==(const LeftOut&) const = default;
};

/// All that is left out of a scene, in the order in which it was found. Each thing is there once. Of more than
/// `most_named` things with the same reason, the last that is named says how many follow.
class LeftOutList {
public:
    static constexpr std::size_t most_named = 12;

    using value_type = LeftOut;
    using const_iterator = std::vector<LeftOut>::const_iterator;

    const_iterator begin() const { return items_.begin(); }
    const_iterator end() const { return items_.end(); }
    std::size_t size() const { return items_.size(); }
    bool empty() const { return items_.empty(); }
    const LeftOut& operator[](std::size_t i) const { return items_[i]; }

    /// Cost: independent of how much is there already, up to a logarithm of the number of reasons.
    void add(std::string what, std::string why);

private:
    /// What is left out for one reason.
    struct Group {
        std::size_t named = 0;
        std::size_t last = 0;   ///< in `items_`, the last that is named
        std::string last_name;  ///< without the number of those that follow
        std::size_t unnamed = 0;
        std::unordered_set<std::string> known;
    };

    std::vector<LeftOut> items_;
    std::map<std::string, Group> groups_;  ///< by reason
};

/// Adds to `all`, unless the same is there already.
inline void leave_out(LeftOutList& all, std::string what, std::string why) { all.add(std::move(what), std::move(why)); }

}  // namespace render
