#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// A floor of 21 columns of rooms along x and 10 rows along z. Two rows face each other across a corridor; the middle
// column is a corridor too, which joins the others. Walls stand between all of them.
constexpr int columns = 21;
constexpr int crossing = 10;  ///< the column without rooms
constexpr int corridors = 5;
constexpr float room_width = 4.2f;
constexpr float room_depth = 5.0f;
constexpr float corridor_width = 2.0f;
constexpr float wall = 0.15f;
constexpr float ceiling = 2.7f;
constexpr float door_height = 2.1f;
constexpr float door_from = 0.5f;  ///< along its room
constexpr float door_to = 1.4f;

constexpr float column_pitch = room_width + wall;
constexpr float block_pitch = 2.0f * (room_depth + wall) + corridor_width + wall;

constexpr float panel_side = 0.6f;
constexpr float lamp_side = 0.12f;
constexpr float light_offset = 1e-4f;  ///< of lights from what shines

/// Where a room is: its corner of least x and z on the floor, and on which side of it the corridor lies.
struct Room {
    glm::vec3 corner;
    bool door_at_high_z;
};

/// A square that shines downwards or upwards.
struct Fixture {
    glm::vec3 corner;
    float side;
    float up;  ///< 1 or -1
    glm::vec3 radiance;

    glm::vec3 power() const { return radiance * side * side; }
};

class OfficeFloor {
public:
    explicit OfficeFloor(std::size_t lights) : m_(scene_) {
        paint_all();
        add_shell();
        add_corridor_panels();
        Dice dice(907);
        for (const Room& room : rooms()) add_room(room, dice);
        add_lights(lights);
        const glm::vec3 lit = bright_room().corner, unlit = dark_room().corner;
        scene_.cameras.push_back(
            {"room", lit + glm::vec3(3.7f, 1.7f, 4.8f), lit + glm::vec3(1.5f, 0.85f, 1.2f), {0, 1, 0}, 66.0f});
        const float aisle = 2.0f * block_pitch + room_depth + 2.0f * wall + 0.5f * corridor_width;
        scene_.cameras.push_back({"corridor",
                                  {7.0f * column_pitch, 1.6f, aisle + 0.3f},
                                  {14.0f * column_pitch, 1.1f, aisle},
                                  {0, 1, 0},
                                  58.0f});
        scene_.cameras.push_back(
            {"dark room", unlit + glm::vec3(3.9f, 1.7f, 4.5f), unlit + glm::vec3(1.2f, 0.9f, 0.6f), {0, 1, 0}, 62.0f});
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        plaster_ = m_.paint("plaster", {0.70f, 0.69f, 0.66f}, 0.9f);
        ceiling_ = m_.paint("ceiling", {0.80f, 0.80f, 0.79f}, 0.9f);
        carpet_ = m_.paint("carpet", {0.20f, 0.23f, 0.27f}, 1.0f);
        oak_ = m_.paint("oak", {0.42f, 0.27f, 0.14f}, 0.3f);
        white_ = m_.paint("white board", {0.76f, 0.76f, 0.75f}, 0.28f);
        steel_ = m_.paint("steel", {0.40f, 0.41f, 0.43f}, 0.4f);
        plastic_ = m_.paint("black plastic", {0.04f, 0.04f, 0.045f}, 0.3f);
        seat_ = m_.paint("seat", {0.16f, 0.10f, 0.30f}, 0.6f);
        leaf_ = m_.paint("leaf", {0.08f, 0.28f, 0.07f}, 0.4f);
        scene_.materials[leaf_].double_sided = true;
        pot_ = m_.paint("pot", {0.60f, 0.57f, 0.52f}, 0.5f);
        covers_ = {
            m_.paint("red binder", {0.45f, 0.06f, 0.05f}, 0.5f), m_.paint("green binder", {0.06f, 0.24f, 0.11f}, 0.5f),
            m_.paint("blue binder", {0.06f, 0.12f, 0.34f}, 0.5f), m_.paint("gray binder", {0.45f, 0.45f, 0.46f}, 0.5f)};
        daylight_tube_ = glowing("daylight panel", {9.2f, 10.0f, 10.8f});
        warm_tube_ = glowing("warm panel", {11.4f, 10.0f, 7.8f});
        daylight_wash_ = glowing("daylight panel, upper side", {4.2f, 4.6f, 5.0f});
        warm_wash_ = glowing("warm panel, upper side", {5.2f, 4.6f, 3.6f});
        bulb_ = glowing("desk lamp", {120.0f, 90.0f, 52.0f});
    }

    /// What is seen to shine, and lights nothing by itself: `add_lights` does.
    std::uint32_t glowing(const char* name, const glm::vec3& radiance) {
        const std::uint32_t paint = m_.paint(name, glm::vec3(0.0f), 1.0f);
        scene_.materials[paint].emission = radiance;
        scene_.materials[paint].only_seen = true;
        return paint;
    }

    static Room room_at(int column, int corridor, bool behind) {
        const float x = wall + column_pitch * static_cast<float>(column);
        const float z = wall + block_pitch * static_cast<float>(corridor);
        return {{x, 0.0f, behind ? z + room_depth + 2.0f * wall + corridor_width : z}, !behind};
    }
    /// Those that cameras stand in; their doors are open.
    static Room bright_room() { return room_at(5, 2, false); }
    static Room dark_room() { return room_at(13, 2, true); }
    static std::vector<Room> rooms() {
        std::vector<Room> all;
        for (int corridor = 0; corridor < corridors; ++corridor) {
            for (const bool behind : {false, true}) {
                for (int column = 0; column < columns; ++column) {
                    if (column != crossing) all.push_back(room_at(column, corridor, behind));
                }
            }
        }
        return all;
    }

    /// Floor, ceiling and all walls with their doorways, in one piece.
    void add_shell() {
        BlockGrid grid;
        enum class Strip : std::uint8_t { partition, room, door, corridor };
        std::vector<Strip> along_x, along_z;
        const auto append = [](std::vector<float>& planes, std::vector<Strip>& strips, Strip strip, float width) {
            if (planes.empty()) planes.push_back(0.0f);
            planes.push_back(planes.back() + width);
            strips.push_back(strip);
        };
        for (int column = 0; column < columns; ++column) {
            const Strip inside = column == crossing ? Strip::corridor : Strip::room;
            append(grid.planes[0], along_x, Strip::partition, wall);
            append(grid.planes[0], along_x, inside, door_from);
            append(grid.planes[0], along_x, inside == Strip::room ? Strip::door : inside, door_to - door_from);
            append(grid.planes[0], along_x, inside, room_width - door_to);
        }
        append(grid.planes[0], along_x, Strip::partition, wall);
        for (int corridor = 0; corridor < corridors; ++corridor) {
            append(grid.planes[2], along_z, Strip::partition, wall);
            append(grid.planes[2], along_z, Strip::room, room_depth);
            append(grid.planes[2], along_z, Strip::door, wall);
            append(grid.planes[2], along_z, Strip::corridor, corridor_width);
            append(grid.planes[2], along_z, Strip::door, wall);
            append(grid.planes[2], along_z, Strip::room, room_depth);
        }
        append(grid.planes[2], along_z, Strip::partition, wall);
        grid.planes[1] = {-wall, 0.0f, door_height, ceiling, ceiling + wall};

        const auto is_free = [&](const glm::ivec3& cell) {
            if (cell.y == 0 || cell.y == 3) return false;
            const bool at_rim = cell.x == 0 || cell.x + 1 == grid.cells(0) || cell.z == 0 ||
                                cell.z + 1 == grid.cells(2);
            if (at_rim) return false;
            const Strip x = along_x[static_cast<std::size_t>(cell.x)], z = along_z[static_cast<std::size_t>(cell.z)];
            if (x == Strip::corridor || z == Strip::corridor) return true;
            if (z == Strip::room) return x != Strip::partition;
            return z == Strip::door && x == Strip::door && cell.y == 1;
        };
        m_.stand({});
        m_.blocks(
            grid, [&](const glm::ivec3& cell) { return !is_free(cell); },
            [&](const glm::ivec3& cell, int axis, int) {
                if (axis != 1) return plaster_;
                return cell.y == 0 ? carpet_ : ceiling_;
            });
    }

    /// A lamp of square panels that hangs below the ceiling at `middle` and shines down and, less, up.
    void add_panel(const glm::vec3& middle, std::uint32_t down, std::uint32_t up) {
        constexpr float half = 0.5f * panel_side;
        constexpr float drop = 0.35f;
        m_.stand({});
        m_.material = steel_;
        m_.box(middle + glm::vec3(-half - 0.02f, -drop - 0.05f, -half - 0.02f),
               middle + glm::vec3(half + 0.02f, -drop, half + 0.02f));
        for (const float x : {-0.2f, 0.2f}) {
            m_.box(middle + glm::vec3(x - 0.004f, -drop + 0.003f, -0.004f),
                   middle + glm::vec3(x + 0.004f, 0.0f, 0.004f));
        }
        add_glow(middle + glm::vec3(-half, -drop - 0.052f, -half), panel_side, down);
        add_glow(middle + glm::vec3(-half, -drop + 0.002f, -half), panel_side, up, 1.0f);
    }
    /// A square that shines downwards, or upwards, in coordinates of the world.
    void add_glow(const glm::vec3& corner, float side, std::uint32_t paint, float up = -1.0f) {
        m_.stand({});
        m_.material = paint;
        const glm::vec3 u(side, 0.0f, 0.0f), v(0.0f, 0.0f, side);
        m_.quad(corner, up > 0.0f ? v : u, up > 0.0f ? u : v);
        fixtures_.push_back({corner, side, up, scene_.materials[paint].emission});
    }

    void add_corridor_panels() {
        for (int corridor = 0; corridor < corridors; ++corridor) {
            const float z = block_pitch * static_cast<float>(corridor) + room_depth + 2.0f * wall +
                            0.5f * corridor_width;
            for (int column = 0; column < columns; ++column) {
                add_panel({wall + column_pitch * (static_cast<float>(column) + 0.5f), ceiling, z}, daylight_tube_,
                          daylight_wash_);
            }
        }
    }

    void add_room(const Room& room, Dice& dice) {
        const bool is_open = dice.pick(2) == 0;
        const bool is_bright = room.corner == bright_room().corner, is_dark = room.corner == dark_room().corner;
        const bool is_lit = (dice.pick(6) != 0 || is_bright) && !is_dark;
        const bool is_warm = dice.pick(2) == 0;
        const glm::vec3 middle = room.corner + glm::vec3(0.5f * room_width, 0.0f, 0.5f * room_depth);
        if (is_lit) {
            for (const float x : {-0.95f, 0.95f}) {
                for (const float z : {-1.2f, 1.2f})
                    add_panel(middle + glm::vec3(x, ceiling, z), is_warm ? warm_tube_ : daylight_tube_,
                              is_warm ? warm_wash_ : daylight_wash_);
            }
        }
        add_door(room, is_open || is_bright || is_dark, dice);
        const float back = room.door_at_high_z ? room.corner.z + 0.05f : room.corner.z + room_depth - 0.05f;
        const float inwards = room.door_at_high_z ? 1.0f : -1.0f;
        const std::size_t desks = 1 + dice.pick(2);
        for (std::size_t i = 0; i < desks; ++i) {
            const float x = room.corner.x + (i == 0 ? 1.3f : 3.1f);
            add_desk({x, 0.001f, back + inwards * 0.9f}, inwards, dice, dice.pick(3) != 0);
        }
        const glm::vec3 shelf(room.corner.x + room_width - 0.002f, 0.001f, middle.z + inwards * 0.9f);
        m_.stand(shelf, -90.0f);
        add_bookcase(m_, 1.6f, 1.9f, 4, dice, dice.pick(2) == 0 ? oak_ : white_, covers_);
        if (dice.pick(2) == 0) {
            m_.stand({room.corner.x + 0.45f, 0.001f, middle.z - inwards * 0.1f});
            add_plant(m_, dice.uniform(0.7f, 1.1f), 16, dice, pot_, leaf_);
        }
        m_.stand({});
        m_.material = white_;
        m_.box({room.corner.x + 0.001f, 0.9f, middle.z - 0.3f}, {room.corner.x + 0.02f, 1.9f, middle.z + 1.2f});
    }

    /// The leaf of a door, in its doorway or turned into the room.
    void add_door(const Room& room, bool is_open, Dice& dice) {
        const float z = room.door_at_high_z ? room.corner.z + room_depth + 0.05f : room.corner.z - 0.05f;
        const float turn = is_open ? dice.uniform(60.0f, 95.0f) : 0.0f;
        m_.stand({room.corner.x + door_from + 0.005f, 0.005f, z}, room.door_at_high_z ? turn : -turn);
        m_.material = oak_;
        constexpr float width = door_to - door_from - 0.01f;
        m_.box({0.0f, 0.0f, -0.02f}, {width, door_height - 0.01f, 0.02f});
        m_.material = steel_;
        m_.box({width - 0.12f, 1.0f, -0.07f}, {width - 0.04f, 1.03f, 0.07f});
    }

    /// A desk with a screen, a chair before it and, if it `has_lamp`, a lamp. Its user looks against `inwards` along z.
    void add_desk(const glm::vec3& at, float inwards, Dice& dice, bool has_lamp) {
        const float degrees = inwards > 0.0f ? 0.0f : 180.0f;
        m_.stand(at, degrees);
        m_.material = dice.pick(2) == 0 ? oak_ : white_;
        m_.box({-0.8f, 0.72f, -0.4f}, {0.8f, 0.75f, 0.4f});
        m_.box({-0.78f, 0.0f, -0.38f}, {-0.75f, 0.719f, 0.38f});
        m_.box({0.36f, 0.05f, -0.38f}, {0.78f, 0.719f, 0.36f});
        m_.box({-0.749f, 0.3f, -0.38f}, {0.359f, 0.719f, -0.36f});
        m_.material = plastic_;
        m_.box({-0.42f, 0.751f, -0.25f}, {-0.12f, 0.765f, -0.05f});
        m_.box({-0.30f, 0.765f, -0.22f}, {-0.24f, 0.95f, -0.18f});
        m_.box({-0.58f, 0.88f, -0.18f}, {0.04f, 1.24f, -0.15f});
        m_.box({-0.5f, 0.751f, 0.05f}, {-0.06f, 0.765f, 0.2f});
        m_.stand(at + glm::vec3(0.58f, 0.751f, 0.1f * inwards), dice.uniform(0.0f, 90.0f));
        add_book_stack(m_, 2 + static_cast<int>(dice.pick(4)), dice, covers_);
        m_.stand(at + glm::vec3(dice.uniform(-0.3f, 0.1f), 0.0f, 0.75f * inwards),
                 degrees + 180.0f + dice.uniform(-25.0f, 25.0f));
        add_chair(m_, steel_, seat_);
        if (!has_lamp) return;
        // A foot, a stem and a shade that is open below.
        m_.stand({});
        const glm::vec3 foot = at + glm::vec3(0.25f, 0.751f, -0.2f * inwards);
        m_.material = steel_;
        m_.box(foot + glm::vec3(-0.07f, 0.0f, -0.07f), foot + glm::vec3(0.07f, 0.02f, 0.07f));
        m_.box(foot + glm::vec3(-0.008f, 0.02f, -0.008f), foot + glm::vec3(0.008f, 0.42f, 0.008f));
        const glm::vec3 shade = foot + glm::vec3(0.0f, 0.42f, 0.1f * inwards);
        m_.box(shade + glm::vec3(-0.09f, 0.0f, -0.12f), shade + glm::vec3(0.09f, 0.05f, 0.12f));
        add_glow(shade + glm::vec3(-0.5f * lamp_side, -0.002f, -0.5f * lamp_side), lamp_side, bulb_);
    }

    /// `count` oriented lights of equal luminous power over all that shines, evenly over each square.
    void add_lights(std::size_t count) {
        double total = 0.0;
        for (const Fixture& f : fixtures_) total += static_cast<double>(f.power().y);
        double before = 0.0;
        std::size_t fixture = 0;
        std::size_t own = 0;  // of the fixture so far
        scene_.oriented.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double at = total * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
            while (fixture + 1 < fixtures_.size() && at >= before + static_cast<double>(fixtures_[fixture].power().y)) {
                before += static_cast<double>(fixtures_[fixture++].power().y);
                own = 0;
            }
            const Fixture& f = fixtures_[fixture];
            // The plastic sequence in two dimensions: even for any number.
            const auto place = [&](double step) {
                const double u = 0.5 + step * static_cast<double>(own);
                return static_cast<float>(u - std::floor(u)) * f.side;
            };
            const glm::vec3 p = f.corner +
                                glm::vec3(place(0.7548776662466927), f.up * light_offset, place(0.5698402909980532));
            ++own;
            const glm::vec3 intensity = f.radiance * static_cast<float>(total / static_cast<double>(f.radiance.y) /
                                                                        static_cast<double>(count));
            scene_.oriented.push_back({p, {0.0f, f.up, 0.0f}, intensity, {}});
        }
    }

    Scene scene_;
    Modeller m_;
    std::vector<Fixture> fixtures_;
    std::uint32_t plaster_{}, ceiling_{}, carpet_{}, oak_{}, white_{}, steel_{}, plastic_{}, seat_{}, leaf_{}, pot_{},
        daylight_tube_{}, warm_tube_{}, daylight_wash_{}, warm_wash_{}, bulb_{};
    std::array<std::uint32_t, 4> covers_{};
};

}  // namespace

Scene builtin_office(std::size_t lights) { return OfficeFloor(lights).scene(); }

}  // namespace render
