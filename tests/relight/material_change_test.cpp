#include <cmath>

#include <gtest/gtest.h>
#include <relight/material_change.hpp>

namespace {

using Model = render::SurfaceLobes::Model;

render::SurfaceLobes lobes_of(Model model, float shininess) {
    render::SurfaceLobes lobes;
    lobes.diffuse = {0.1f, 0.3f, 0.6f};
    lobes.transmitted = {0.2f, 0.1f, 0.3f};
    lobes.specular = {0.3f, 0.2f, 0.1f};
    lobes.model = model;
    lobes.shininess = shininess;
    return lobes;
}

TEST(MaterialChange, FactorsOfOneChangeNoBit) {
    for (const Model model : {Model::lambert, Model::phong, Model::microfacet}) {
        const render::SurfaceLobes own = lobes_of(model, 0.3f);
        const render::SurfaceLobes same = relight::changed(own, {.is_diffuse = true});
        EXPECT_EQ(same.diffuse, own.diffuse);
        EXPECT_EQ(same.transmitted, own.transmitted);
        EXPECT_EQ(same.shininess, own.shininess);
    }
}

TEST(MaterialChange, AlbedoIsMultipliedUpToOne) {
    const render::SurfaceLobes own = lobes_of(Model::phong, 20.0f);
    const render::SurfaceLobes twice = relight::changed(own, {.albedo = 2.0f});
    EXPECT_EQ(twice.diffuse.x, 0.2f);
    EXPECT_EQ(twice.transmitted.y, 0.2f);
    // 1.8 of the third channel would be reflected or let through: what is left keeps its proportions.
    EXPECT_FLOAT_EQ(twice.diffuse.z + twice.transmitted.z, 1.0f);
    EXPECT_FLOAT_EQ(twice.diffuse.z, 2.0f * twice.transmitted.z);
    EXPECT_EQ(twice.specular, own.specular);
    EXPECT_EQ(twice.shininess, own.shininess);
}

TEST(MaterialChange, GlossIsAsWideAsItIsAskedFor) {
    const auto half_width = [](float exponent) {
        return std::acos(std::pow(0.5, 1.0 / static_cast<double>(exponent)));
    };
    const float narrow = relight::changed(lobes_of(Model::phong, 400.0f), {.gloss_width = 0.5f}).shininess;
    EXPECT_NEAR(half_width(narrow) / half_width(400.0f), 0.5, 0.005);
    EXPECT_GE(relight::changed(lobes_of(Model::phong, 2.0f), {.gloss_width = 100.0f}).shininess, 0.0f);

    const render::SurfaceLobes own = lobes_of(Model::microfacet, 0.25f);
    EXPECT_EQ(relight::changed(own, {.gloss_width = 2.0f}).shininess, 0.5f);
    EXPECT_EQ(relight::changed(own, {.gloss_width = 20.0f}).shininess, 1.0f);
    EXPECT_EQ(relight::changed(own, {.gloss_width = 0.001f}).shininess, 4e-4f);
    EXPECT_EQ(relight::changed(own, {.gloss_width = 2.0f}).diffuse, own.diffuse);
}

}  // namespace
