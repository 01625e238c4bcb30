#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "io/gltf_writer.hpp"
#include "io/load_gltf.hpp"
#include "io/picture.hpp"
#include "scenes/builtin.hpp"
#include "surfaces/texture.hpp"

namespace render {
namespace {

using Json = GltfWriter::Json;

Json to_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Writes a glTF file with a tile for each feature of the format. The left half of a tile uses the feature, the right
/// half has as a plain color what a correct reader makes of it: then the two halves look the same.
class TestCard {
public:
    TestCard() {
        add_colors_and_textures();
        add_emission();
        add_reflection();
        add_shapes();
        add_lights();
        add_cameras();
    }

    Scene scene() const { return load_gltf(GltfWriter::path, MemoryFiles(file_.files())); }

private:
    static constexpr float pitch = test_card_pitch;
    // Colors that pictures of 8 bits hold exactly.
    static inline const glm::vec3 rust{srgb_to_linear(218.0f / 255.0f), srgb_to_linear(137.0f / 255.0f),
                                       srgb_to_linear(89.0f / 255.0f)};
    static inline const glm::vec3 sea{srgb_to_linear(89.0f / 255.0f), srgb_to_linear(160.0f / 255.0f),
                                      srgb_to_linear(203.0f / 255.0f)};

    // ---- parts

    /// Corners of a half tile, counter-clockwise from the lower left.
    static std::vector<float> corners(const glm::vec3& at, float width = 0.5f, float height = 1.0f) {
        return {at.x,         at.y,          at.z, at.x + width, at.y,          at.z,
                at.x + width, at.y + height, at.z, at.x,         at.y + height, at.z};
    }

    Json square(const glm::vec3& at, float width = 0.5f, float height = 1.0f) {
        return {{"POSITION", file_.add(corners(at, width, height), "VEC3", 3)}};
    }

    /// With uvs that run over [low, high] in both directions, v downwards.
    Json square_with_uvs(const glm::vec3& at, float low, float high, const char* name = "TEXCOORD_0") {
        Json attributes = square(at);
        attributes[name] = file_.add(std::vector<float>{low, high, high, high, high, low, low, low}, "VEC2", 2);
        return attributes;
    }

    std::size_t show(const Json& attributes, std::size_t material, Json members = Json::object()) {
        members["material"] = material;
        return file_.add_node({{"mesh", file_.add_mesh(attributes, members)}});
    }

    /// Where the next tile's lower left corner is.
    glm::vec3 next_tile() {
        const int column = tiles_ % test_card_columns;
        const int row = tiles_ / test_card_columns;
        ++tiles_;
        return {pitch * static_cast<float>(column), -pitch * static_cast<float>(row), 0.0f};
    }

    /// The right half: a surface that reflects diffusely alone.
    void show_twin(const glm::vec3& tile, const glm::vec3& color) { show(square(tile + half()), matt(color)); }
    static glm::vec3 half() { return {0.5f, 0.0f, 0.0f}; }

    Json extension(const char* name, const Json& members) { return {{"extensions", {{name, members}}}}; }

    std::size_t matt(const glm::vec3& color) {
        return file_.add_material(extension("KHR_materials_specular", {{"specularFactor", 0.0}}),
                                  {{"baseColorFactor", {color.x, color.y, color.z, 1.0}}});
    }

    /// One whose base color is `texture`, else matt.
    std::size_t matt_texture(const Json& texture, Json members = Json::object()) {
        members.update(extension("KHR_materials_specular", {{"specularFactor", 0.0}}));
        return file_.add_material(members, {{"baseColorTexture", texture}});
    }

    std::size_t glowing(const glm::vec3& radiance) {
        const std::size_t material = matt(glm::vec3(0.0f));
        file_.json["materials"][material]["emissiveFactor"] = to_json(radiance);
        return material;
    }

    /// A row of linear colors; `sampler`: of the glTF file.
    std::size_t texture(const std::vector<glm::vec3>& row, const Json& sampler) {
        const std::vector<char> png = png_bytes(static_cast<int>(row.size()), 1, row);
        const std::size_t view = file_.add_bytes(std::string(png.begin(), png.end()));
        const std::size_t image = file_.append("images", {{"bufferView", view}, {"mimeType", "image/png"}});
        return file_.append("textures", {{"source", image}, {"sampler", file_.append("samplers", sampler)}});
    }

    // ---- tiles

    void add_colors_and_textures() {
        const Json nearest = {{"magFilter", 9728}, {"wrapS", 10497}};
        glm::vec3 at = next_tile();  // vertex colors
        Json attributes = square(at);
        std::vector<float> colors;
        for (int i = 0; i < 4; ++i) colors.insert(colors.end(), {rust.x, rust.y, rust.z});
        attributes["COLOR_0"] = file_.add(colors, "VEC3", 3);
        show(attributes, matt(glm::vec3(1.0f)));
        show_twin(at, rust);

        at = next_tile();  // a texture, sRGB
        show(square_with_uvs(at, 0.0f, 1.0f), matt_texture({{"index", texture({sea}, {{"magFilter", 9729}})}}));
        show_twin(at, sea);

        at = next_tile();  // NEAREST: the texel that a point lies in, up to its edge
        show(square_with_uvs(at, 0.3f, 0.49f), matt_texture({{"index", texture({rust, sea}, nearest)}}));
        show_twin(at, rust);

        at = next_tile();  // mirrored: the second copy begins with the last texel
        show(square_with_uvs(at, 1.05f, 1.45f),
             matt_texture({{"index", texture({rust, sea}, {{"magFilter", 9728}, {"wrapS", 33648}})}}));
        show_twin(at, sea);

        at = next_tile();  // clamped
        show(square_with_uvs(at, 1.05f, 1.45f),
             matt_texture({{"index", texture({rust, sea}, {{"magFilter", 9728}, {"wrapS", 33071}})}}));
        show_twin(at, sea);

        at = next_tile();  // the second set of coordinates
        attributes = square_with_uvs(at, 0.05f, 0.45f);
        attributes.update(square_with_uvs(at, 0.55f, 0.95f, "TEXCOORD_1"));
        show(attributes, matt_texture({{"index", texture({rust, sea}, nearest)}, {"texCoord", 1}}));
        show_twin(at, sea);

        at = next_tile();  // KHR_texture_transform
        Json info = extension("KHR_texture_transform", {{"offset", {0.5, 0.0}}});
        info["index"] = texture({rust, sea}, nearest);
        show(square_with_uvs(at, 0.05f, 0.45f), matt_texture(info));
        show_twin(at, sea);

        at = next_tile();  // alphaMode MASK: holes where alpha is below a half
        attributes = square(at);
        attributes["COLOR_0"] = file_.add(std::vector<float>{1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC4",
                                          4);
        std::size_t material = matt(rust);
        file_.json["materials"][material]["alphaMode"] = "MASK";
        show(attributes, material);
        show(square(at - glm::vec3(0.0f, 0.0f, 0.1f)), matt(sea));
        show(square(at + half(), 0.5f, 0.5f), matt(sea));
        show(square(at + glm::vec3(0.5f, 0.5f, 0.0f), 0.5f, 0.5f), matt(rust));

        at = next_tile();  // alphaMode BLEND: light passes to and fro
        material = matt(rust);
        file_.json["materials"][material]["alphaMode"] = "BLEND";
        file_.json["materials"][material]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.25;
        show(square(at), material);
        show(square(at - glm::vec3(0.0f, 0.0f, 0.1f)), matt(sea));
        show_twin(at, 0.25f * rust + 0.75f * 0.75f * sea);

        at = next_tile();  // an image that cannot be read, with one that can
        const std::size_t fallback = texture({sea}, nearest);
        const std::size_t webp = file_.append("images", {{"uri", "better.webp"}, {"name", "better.webp"}});
        file_.json["textures"][fallback].update(extension("EXT_texture_webp", {{"source", webp}}));
        show(square_with_uvs(at, 0.0f, 1.0f), matt_texture({{"index", fallback}}));
        show_twin(at, sea);
    }

    void add_emission() {
        glm::vec3 at = next_tile();  // KHR_materials_emissive_strength
        std::size_t material = glowing(0.5f * rust);
        file_.json["materials"][material]["extensions"]["KHR_materials_emissive_strength"] = {
            {"emissiveStrength", 2.0}};
        show(square(at), material);
        show(square(at + half()), glowing(rust));

        at = next_tile();  // emissive texture, on the back of a double-sided surface
        material = glowing(glm::vec3(1.0f));
        file_.json["materials"][material]["doubleSided"] = true;
        file_.json["materials"][material]["emissiveTexture"] = {{"index", texture({sea}, {{"magFilter", 9729}})}};
        const std::size_t turned = file_.add(std::vector<std::uint16_t>{0, 2, 1, 0, 3, 2}, "SCALAR", 1);
        show(square_with_uvs(at, 0.0f, 1.0f), material, {{"indices", turned}});
        show(square(at + half()), glowing(sea));

        at = next_tile();  // KHR_materials_unlit
        show(square(at), file_.add_material(extension("KHR_materials_unlit", Json::object()),
                                            {{"baseColorFactor", {rust.x, rust.y, rust.z, 1.0}}}));
        show(square(at + half()), glowing(rust));
    }

    void add_reflection() {
        glm::vec3 at = next_tile();  // KHR_materials_pbrSpecularGlossiness
        show(square(at), file_.add_material(extension("KHR_materials_pbrSpecularGlossiness",
                                                      {{"diffuseFactor", {rust.x, rust.y, rust.z, 1.0}},
                                                       {"specularFactor", {0.0, 0.0, 0.0}},
                                                       {"glossinessFactor", 0.0}})));
        show_twin(at, rust);

        at = next_tile();  // KHR_materials_specular against KHR_materials_ior: 0.04 x 25/9 is an index of 2
        constexpr double reflectance = 25.0 / 9.0;
        const Json glossy = {{"baseColorFactor", {sea.x, sea.y, sea.z, 1.0}}, {"roughnessFactor", 0.5}};
        show(square(at),
             file_.add_material(extension("KHR_materials_specular",
                                          {{"specularColorFactor", {reflectance, reflectance, reflectance}}}),
                                glossy));
        show(square(at + half()), file_.add_material(extension("KHR_materials_ior", {{"ior", 2.0}}), glossy));

        at = next_tile();  // metallic and roughness from a texture: blue and green
        const glm::vec3 texel(0.0f, srgb_to_linear(128.0f / 255.0f),
                              1.0f);  // numbers, where the writer of pictures takes light
        const std::size_t map = texture({texel}, {{"magFilter", 9728}});
        show(square_with_uvs(at, 0.0f, 1.0f),
             file_.add_material(Json::object(), {{"baseColorFactor", {rust.x, rust.y, rust.z, 1.0}},
                                                 {"metallicFactor", 1.0},
                                                 {"metallicRoughnessTexture", {{"index", map}}}}));
        show(square(at + half()),
             file_.add_material(Json::object(), {{"baseColorFactor", {rust.x, rust.y, rust.z, 1.0}},
                                                 {"metallicFactor", 1.0},
                                                 {"roughnessFactor", 128.0 / 255.0}}));

        at = next_tile();  // a mirror leaning back by 45 degrees shows the lamp above
        Json attributes = {
            {"POSITION", file_.add(std::vector<float>{at.x, at.y, 0.5f, at.x + 0.5f, at.y, 0.5f, at.x + 0.5f,
                                                      at.y + 1.0f, -0.5f, at.x, at.y + 1.0f, -0.5f},
                                   "VEC3", 3)}};
        show(attributes, file_.add_material(Json::object(), {{"metallicFactor", 1.0},
                                                             {"roughnessFactor", 0.0},
                                                             {"baseColorFactor", {sea.x, sea.y, sea.z, 1.0}}}));
        const std::size_t lamp = file_.add(
            std::vector<float>{at.x - 2, 40, 2, at.x - 2, 40, -2, at.x + 3, 40, -2, at.x + 3, 40, 2}, "VEC3", 3);
        show({{"POSITION", lamp}}, glowing(glm::vec3(1.0f)));
        const float fresnel = std::pow(1.0f - std::sqrt(0.5f), 5.0f);
        show(square(at + half()), glowing(glm::mix(sea, glm::vec3(1.0f), fresnel)));

        at = next_tile();  // KHR_materials_transmission: a smooth pane takes 4 %, and tints twice
        const glm::vec3 tint(0.6f, 0.9f, 0.8f);
        show(square(at),
             file_.add_material(extension("KHR_materials_transmission", {{"transmissionFactor", 1.0}}),
                                {{"baseColorFactor", {tint.x, tint.y, tint.z, 1.0}}, {"roughnessFactor", 0.0}}));
        show(square(at - glm::vec3(0.0f, 0.0f, 0.1f)), matt(glm::vec3(0.8f)));
        show_twin(at, 0.96f * tint * tint * 0.8f);

        at = next_tile();  // KHR_materials_diffuse_transmission: half of each, and the light behind is half as bright
        const glm::vec3 through(0.9f, 0.9f, 0.2f);
        Json leaf = extension(
            "KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.5}, {"diffuseTransmissionColorFactor", to_json(through)}});
        leaf["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0.0}};
        show(square(at), file_.add_material(leaf, {{"baseColorFactor", {sea.x, sea.y, sea.z, 1.0}}}));
        show_twin(at, 0.5f * sea + 0.5f * 0.5f * through);

        at = next_tile();  // a normal map that leans by 60 degrees
        const glm::vec3 normal(-std::sqrt(0.75f), 0.0f, 0.5f);
        // What the map holds are numbers; the writer of pictures takes light.
        const glm::vec3 stored = 0.5f * normal + 0.5f;
        const std::size_t bump = texture(
            {{srgb_to_linear(stored.x), srgb_to_linear(stored.y), srgb_to_linear(stored.z)}}, {{"magFilter", 9728}});
        const std::size_t bumpy = matt(rust);
        file_.json["materials"][bumpy]["normalTexture"] = {{"index", bump}};
        show(square_with_uvs(at, 0.0f, 1.0f), bumpy);
        show_twin(at, 0.5f * rust);
    }

    void add_shapes() {
        glm::vec3 at = next_tile();  // a skin: its joint brings the mesh here, its own node would take it away
        const std::size_t joint = file_.add_node({{"translation", {at.x, at.y, 0.0}}});
        Json attributes = square(glm::vec3(0.0f));
        attributes["JOINTS_0"] = file_.add(std::vector<std::uint8_t>(16, 0), "VEC4", 4);
        attributes["WEIGHTS_0"] = file_.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4",
                                            4);
        file_.append("skins", {{"joints", {joint}}});
        std::size_t node = show(attributes, matt(rust));
        file_.json["nodes"][node].update({{"skin", 0}, {"translation", {50, 50, 0}}});
        show_twin(at, rust);

        at = next_tile();  // a morph target of weight 1 / 2
        std::vector<float> away;
        for (int i = 0; i < 4; ++i) away.insert(away.end(), {2.0f * at.x, 2.0f * at.y, 0.0f});
        attributes = square(glm::vec3(0.0f));
        node = show(attributes, matt(sea), {{"targets", Json::array({{{"POSITION", file_.add(away, "VEC3", 3)}}})}});
        file_.json["nodes"][node]["weights"] = {0.5};
        show_twin(at, sea);

        at = next_tile();  // an animation begins here
        node = show(square(glm::vec3(0.0f)), matt(rust));
        const std::size_t times = file_.add(std::vector<float>{0, 1}, "SCALAR", 1);
        const std::size_t places = file_.add(std::vector<float>{at.x, at.y, 0, 9, 9, 9}, "VEC3", 3);
        const Json target = {{"node", node}, {"path", "translation"}};
        file_.append("animations", {{"samplers", Json::array({{{"input", times}, {"output", places}}})},
                                    {"channels", Json::array({{{"sampler", 0}, {"target", target}}})}});
        show_twin(at, rust);

        at = next_tile();  // EXT_mesh_gpu_instancing: two, one above the other
        node = show(square(at, 0.5f, 0.5f), matt(sea));
        const std::size_t steps = file_.add(std::vector<float>{0, 0, 0, 0, 0.5f, 0}, "VEC3", 3);
        file_.json["nodes"][node].update(
            extension("EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", steps}}}}));
        show_twin(at, sea);

        at = next_tile();  // a sparse accessor lifts the upper corners
        attributes = square(at, 0.5f, 0.25f);
        const std::size_t which = file_.add_view(std::vector<std::uint16_t>{2, 3});
        const std::size_t values = file_.add_view(
            std::vector<float>{at.x + 0.5f, at.y + 1.0f, 0.0f, at.x, at.y + 1.0f, 0.0f});
        file_.json["accessors"][attributes["POSITION"].get<std::size_t>()]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", which}, {"componentType", 5123}}},
            {"values", {{"bufferView", values}}}};
        show(attributes, matt(rust));
        show_twin(at, rust);

        at = next_tile();  // uvs without data are zeros; a strip and a fan
        attributes = square(at, 0.5f, 0.5f);
        attributes["TEXCOORD_0"] = file_.append("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
        const std::size_t corner = matt_texture({{"index", texture({sea, rust}, {{"magFilter", 9728}})}});
        show(attributes, corner,
             {{"mode", 5}, {"indices", file_.add(std::vector<std::uint16_t>{0, 1, 3, 2}, "SCALAR", 1)}});
        show(square(at + glm::vec3(0.0f, 0.5f, 0.0f), 0.5f, 0.5f), matt(sea),
             {{"mode", 6}, {"indices", file_.add(std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR", 1)}});
        show_twin(at, sea);

        at = next_tile();  // KHR_mesh_quantization, under a matrix that mirrors
        attributes = {{"POSITION", file_.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 127, 0, 0, 127, 0},
                                             "VEC3", 3, true)}};
        node = show(attributes, matt(rust));
        file_.json["nodes"][node]["matrix"] = {-0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at.x + 0.5f, at.y, 0, 1};
        show_twin(at, rust);

        at = next_tile();  // vertex normals that lean by 60 degrees
        attributes = square(at);
        std::vector<float> leaning;
        for (int i = 0; i < 4; ++i) leaning.insert(leaning.end(), {0.0f, std::sqrt(0.75f), 0.5f});
        attributes["NORMAL"] = file_.add(leaning, "VEC3", 3);
        show(attributes, matt(sea));
        show_twin(at, 0.5f * sea);

        at = next_tile();  // positions among other data
        const std::vector<float> p = corners(at);
        std::vector<float> mixed;
        for (std::size_t i = 0; i < 12; i += 3) mixed.insert(mixed.end(), {p[i], p[i + 1], p[i + 2], 9.0f, 9.0f});
        attributes = {{"POSITION", file_.add(mixed, "VEC3", 5)}};
        const std::size_t view = file_.json["accessors"].back()["bufferView"];
        file_.json["bufferViews"][view]["byteStride"] = 20;
        show(attributes, matt(rust));
        show_twin(at, rust);

        at = next_tile();  // KHR_node_visibility: what is hidden does not cover
        show(square(at), matt(sea));
        node = show(square(at + glm::vec3(0.0f, 0.0f, 0.1f)), matt(rust));
        file_.json["nodes"][node].update(extension("KHR_node_visibility", {{"visible", false}}));
        show_twin(at, sea);
    }

    /// All of the card is lit by one light from the viewer and one of half its strength from behind. Below, behind a
    /// board that keeps their light from the card, a point, a spot and a sphere shine on a shelf.
    void add_lights() {
        const auto pi = static_cast<double>(std::numbers::pi);
        Json& lights = file_.json["extensions"]["KHR_lights_punctual"]["lights"];
        lights = Json::array(
            {{{"type", "directional"}, {"intensity", pi}},
             {{"type", "directional"}, {"intensity", pi / 2}},
             {{"type", "point"}, {"color", {1.0, 0.7, 0.4}}, {"intensity", 3.0}},
             {{"type", "spot"},
              {"color", {0.4, 1.0, 0.6}},
              {"intensity", 3.0},
              {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.5}}}},
             {{"type", "point"}, {"color", {0.5, 0.6, 1.0}}, {"intensity", 3.0}, {"extras", {{"radius", 0.15}}}}});
        const auto add = [&](int light, const Json& members) {
            Json node = extension("KHR_lights_punctual", {{"light", light}});
            node.update(members);
            file_.add_node(node);
        };
        add(0, Json::object());
        add(1, {{"rotation", {0, 1, 0, 0}}});
        const float y = -pitch * test_card_rows - 0.6f;
        for (int i = 0; i < 3; ++i)
            add(2 + i, {{"translation", {1.05f + 2.2f * static_cast<float>(i), y + 0.5f, 0.5f}}});
        const float right = pitch * test_card_columns;
        show(square({0.0f, y, 0.0f}, right - 0.1f, 1.1f), matt(glm::vec3(0.1f)));
        const std::size_t board = file_.add(
            std::vector<float>{-9, y + 1.2f, -9, -9, y + 1.2f, 9, 15, y + 1.2f, 9, 15, y + 1.2f, -9}, "VEC3", 3);
        show({{"POSITION", board}}, matt(glm::vec3(0.0f)));
    }

    void add_cameras() {
        const float width = pitch * test_card_columns - 0.1f;
        const glm::vec3 middle(0.5f * width, test_card_middle, 10.0f);
        file_.append("cameras", {{"name", "card"},
                                 {"type", "orthographic"},
                                 {"orthographic",
                                  {{"xmag", 0.5 * static_cast<double>(width)},
                                   {"ymag", 0.5 * static_cast<double>(test_card_height)},
                                   {"znear", 0.1},
                                   {"zfar", 100.0}}}});
        file_.append("cameras",
                     {{"name", "eye"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
        file_.add_node({{"camera", 0}, {"translation", to_json(middle)}});
        file_.add_node({{"camera", 1}, {"translation", to_json(middle)}});
    }

    GltfWriter file_;
    int tiles_ = 0;
};

}  // namespace

Scene builtin_test_card() { return TestCard().scene(); }

}  // namespace render
