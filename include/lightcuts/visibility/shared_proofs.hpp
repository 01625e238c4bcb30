#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "flood.hpp"
#include "hidden_lights.hpp"
#include "oracle.hpp"

namespace lightcuts {

/// Proofs that lights are hidden from all receivers of a group, each made once and remembered: what a HidingOracle
/// answers from where receivers that are near to one another are shaded one after the other. Keep one a thread; no
/// allocation once warm.
class SharedProofs {
public:
    /// Forgets all, for other receivers.
    void start(const ReceiverBox& receivers) {
        receivers_ = receivers;
        for (Entry& e : entries_) e.answer = Answer::none;
        count_ = 0;
    }

    /// True only if no light of `lights`, a Box or a DirectionBox, is visible from `receiver`. Proved from the group if
    /// that has it: its rays start in the group's box, and it has the group's horizon, if that has one; else from the
    /// receiver itself, and not remembered. `hidden`: a HiddenLights, always the same between two calls of `start`.
    template <class Hidden, class Lights>
    bool hides(const Hidden& hidden, const ReceiverBox& receiver, const Lights& lights) {
        if (!has(receiver)) return hidden.hides(receiver, lights, &steps_);
        constexpr bool distant = std::same_as<Lights, DirectionBox>;
        const Box& box = box_of_lights(lights);
        Entry* entry = find(box, distant);
        if (entry->answer == Answer::none) {
            *entry = {box, distant, hidden.hides(receivers_, lights, &steps_) ? Answer::hidden : Answer::unknown};
            ++count_;
        }
        return entry->answer == Answer::hidden;
    }

    /// What proofs have taken since this was made.
    const ProofSteps& steps() const { return steps_; }

private:
    enum class Answer : std::uint8_t { none, unknown, hidden };

    struct Entry {
        Box box{};
        bool distant = false;
        Answer answer = Answer::none;
    };

    bool has(const ReceiverBox& receiver) const {
        if (!contains(receivers_.box, receiver.box)) return false;
        if (!receivers_.horizon) return true;
        return receiver.horizon && receiver.horizon->normal == receivers_.horizon->normal &&
               contains(receivers_.horizon->positions, receiver.horizon->positions);
    }

    static const Box& box_of_lights(const Box& lights) { return lights; }
    static const Box& box_of_lights(const DirectionBox& lights) { return lights.box; }

    static std::size_t hash(const Box& box, bool distant) {
        std::uint64_t h = distant ? 1u : 0u;
        for (const glm::vec3& corner : {box.lo, box.hi}) {
            for (int axis = 0; axis < 3; ++axis) {
                h = (h ^ std::bit_cast<std::uint32_t>(corner[axis])) * 0x9e3779b97f4a7c15u;
                h ^= h >> 29;
            }
        }
        return static_cast<std::size_t>(h);
    }

    /// Where a box is, or would be.
    Entry* find(const Box& box, bool distant) {
        if (2 * (count_ + 1) > entries_.size()) grow();
        std::size_t slot = hash(box, distant) & (entries_.size() - 1);
        while (entries_[slot].answer != Answer::none &&
               !(entries_[slot].box == box && entries_[slot].distant == distant)) {
            slot = (slot + 1) & (entries_.size() - 1);
        }
        return &entries_[slot];
    }
    void grow() {
        std::vector<Entry> old(entries_.empty() ? 1024 : 2 * entries_.size());
        old.swap(entries_);
        for (const Entry& e : old) {
            if (e.answer != Answer::none) *find(e.box, e.distant) = e;
        }
    }

    ReceiverBox receivers_;
    std::vector<Entry> entries_;  ///< a power of two of them
    std::size_t count_ = 0;
    ProofSteps steps_;
};

}  // namespace lightcuts
