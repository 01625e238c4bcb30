#pragma once

#include <type_traits>
#include <utility>

#include "../shading/receiver.hpp"
#include "hidden_lights.hpp"
#include "shared_proofs.hpp"

namespace lightcuts {

/// An oracle that also proves of whole clusters that they are hidden: a HidingOracle. It keeps a copy of `Oracle`,
/// which may be any other whose class is not final. `Hidden`: a HiddenLights.
template <class Oracle, class Hidden>
    requires(!std::is_final_v<Oracle>)
class ProvingOracle : public Oracle {
public:
    /// `hidden` and `group` are referred to. `group`: proves for all receivers of a group at once, if there is one.
    ProvingOracle(Oracle oracle, const Hidden& hidden, SharedProofs* group = nullptr)
        : Oracle(std::move(oracle)), hidden_(hidden), group_(group) {}
    /// It would refer to what is gone.
    ProvingOracle(Oracle, const Hidden&&, SharedProofs* = nullptr) = delete;

    /// True only if no light of `lights` is visible from `receiver`. `lights`: a Box or a DirectionBox.
    template <class M, class Lights>
    bool hides(const Receiver<M>& receiver, const Lights& lights) const {
        const ReceiverBox box = box_of(receiver);
        return group_ ? group_->hides(hidden_, box, lights) : hidden_.hides(box, lights);
    }

private:
    const Hidden& hidden_;
    SharedProofs* group_;
};

}  // namespace lightcuts
