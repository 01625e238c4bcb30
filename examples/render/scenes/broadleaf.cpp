#include "scenes/broadleaf.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace render {
namespace {

constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;
constexpr float golden_angle = 2.399963f;

/// A piece of wood: bough, branch or twig.
struct Limb {
    glm::vec3 root;
    glm::vec3 direction;  ///< unit
    float length;
    float radius;

    /// A limb bends upwards.
    glm::vec3 at(float t) const { return root + length * (t * direction + glm::vec3(0.0f, 0.18f * t * t, 0.0f)); }
};

class BroadleafBuilder {
public:
    BroadleafBuilder(Modeller& m, const Broadleaf& tree, Dice& dice, std::uint32_t bark,
                     std::span<const std::uint32_t> leaves)
        : m_(m), tree_(tree), dice_(dice), bark_(bark), leaves_(leaves) {}

    void add() {
        const Limb trunk{glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f), 0.8f * tree_.height, 0.022f * tree_.height};
        add_trunk(trunk);
        for (int i = 0; i < tree_.boughs; ++i) {
            const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(tree_.boughs);
            // The crown is widest at two fifths of its height.
            const float width = std::sqrt(1.0f - std::pow(std::abs(t - 0.4f) / 0.65f, 2.0f));
            const float rise = glm::mix(0.25f, 1.5f, t);
            const float angle = golden_angle * static_cast<float>(i) + dice_.uniform(-0.3f, 0.3f);
            const float length = tree_.reach * tree_.height * width * dice_.uniform(0.8f, 1.15f);
            const glm::vec3 direction = glm::normalize(glm::vec3(std::cos(angle), rise, std::sin(angle)));
            const float height = glm::mix(tree_.bare * tree_.height, trunk.length, t);
            add_limb({{0.0f, height, 0.0f}, direction, length, 0.4f * trunk.radius}, 2);
        }
    }

private:
    static constexpr int children = 6;

    void add_trunk(const Limb& trunk) {
        m_.material = bark_;
        std::vector<glm::vec3> rings;
        constexpr int around = 10;
        constexpr int count = 8;
        for (int i = 0; i < count; ++i) {
            const float t = static_cast<float>(i) / (count - 1);
            // Roots spread at the foot.
            const float radius = trunk.radius * (1.0f - 0.75f * t + 0.5f * std::pow(1.0f - t, 12.0f));
            for (int s = 0; s < around; ++s) {
                const float angle = two_pi * static_cast<float>(s) / around;
                rings.emplace_back(radius * std::cos(angle), t * trunk.length, -radius * std::sin(angle));
            }
        }
        m_.sleeve(rings, around);
    }

    /// With what grows on it; `order` 2: a bough, 1: a branch, 0: a twig.
    void add_limb(const Limb& limb, int order) {
        m_.material = bark_;
        const std::array<glm::vec3, 4> path{limb.at(0.0f), limb.at(0.35f), limb.at(0.7f), limb.at(1.0f)};
        m_.tube(path, limb.radius, order == 2 ? 6 : 3, false);
        if (order == 0) {
            for (int i = 0; i < tree_.leaves_a_twig; ++i) add_leaf(limb.at(dice_.uniform(0.1f, 1.0f)));
            return;
        }
        for (int i = 0; i < children; ++i) {
            const float t = glm::mix(0.3f, 1.0f, (static_cast<float>(i) + 0.5f) / children);
            const glm::vec3 way = limb.direction + 0.95f * unit_vector();
            const glm::vec3 direction = glm::normalize(way + glm::vec3(0.0f, 0.1f, 0.0f));
            add_limb({limb.at(t), direction, limb.length * dice_.uniform(0.38f, 0.55f), 0.45f * limb.radius},
                     order - 1);
        }
    }

    void add_leaf(const glm::vec3& root) {
        m_.material = leaves_[dice_.pick(leaves_.size())];
        glm::vec3 way = unit_vector();
        way.y = 0.55f * way.y - 0.15f;  // most hang a little, and none is upright
        const float length = tree_.leaf * dice_.uniform(0.7f, 1.2f);
        m_.blade(root, root + length * way, 0.62f * length, 0.2f * length, 2);
    }

    glm::vec3 unit_vector() {
        const float y = dice_.uniform(-0.98f, 0.98f);
        const float angle = dice_.uniform(0.0f, two_pi);
        const float across = std::sqrt(1.0f - y * y);
        return {across * std::cos(angle), y, across * std::sin(angle)};
    }

    Modeller& m_;
    const Broadleaf& tree_;
    Dice& dice_;
    std::uint32_t bark_;
    std::span<const std::uint32_t> leaves_;
};

}  // namespace

void add_broadleaf(Modeller& m, const Broadleaf& tree, Dice& dice, std::uint32_t bark,
                   std::span<const std::uint32_t> leaves) {
    BroadleafBuilder(m, tree, dice, bark, leaves).add();
}

std::uint32_t paint_leaf(Modeller& m, std::string name, const glm::vec3& color, float roughness) {
    const std::uint32_t index = m.paint(std::move(name), color, roughness);
    Material& material = m.scene.materials[index];
    material.model = Material::Model::microfacet;
    material.diffuse_transmission = 0.45f;
    material.diffuse_transmission_color = glm::min(color * glm::vec3(1.5f, 1.3f, 0.5f), glm::vec3(0.95f));
    return index;
}

}  // namespace render
