#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>
#include <render/io/picture.hpp>

#include "programs.hpp"

namespace {

/// A courtyard with blocks, steps, a lamp and two lights, whose coordinates are multiples of a quarter: exact in floats
/// wherever it stands, up to 4,000 km from the origin.
class Courtyard {
public:
    Courtyard(double scale, double x, double y, double z) : scale_(scale), x_(x), y_(y), z_(z) {
        library_ =
            "newmtl stone\nKd 0.6 0.5 0.4\nnewmtl plaster\nKd 0.3 0.4 0.5\nKs 0.2 0.2 0.2\nNs 20\n"
            "newmtl lamp\nKd 0 0 0\nKe 30 30 20\n";
        obj_ = "mtllib yard.mtl\nusemtl stone\n";
        box(-8, -0.5, -8, 8, 0, 8);
        box(-3, 0, -3, -1, 2, -1.5);
        for (int step = 0; step < 4; ++step) box(1.5, 0.25 * step, -3 + 0.5 * step, 4, 0.25 * (step + 1), 0);
        obj_ += "usemtl plaster\n";
        box(-6, 0, -6, 6, 5, -5.75);
        box(-2.25, 0, 1, -1.75, 3, 1.5);
        obj_ += "usemtl lamp\n";
        quad({-1, 4.75, 0}, {0, 4.75, 0}, {0, 4.75, 0.75}, {-1, 4.75, 0.75});
    }

    const std::string& obj() const { return obj_; }
    const std::string& library() const { return library_; }

    std::string lights() const {
        const double power = scale_ * scale_;
        return "kind,x,y,z,dx,dy,dz,r,g,b\nomni," + at(3, 3.5, 3) + ",,,," + text(20 * power) + "," + text(15 * power) +
               "," + text(10 * power) + "\nomni," + at(-4, 1.25, 2) + ",,,," + text(4 * power) + "," + text(4 * power) +
               "," + text(8 * power) + "\n";
    }
    std::string camera() const { return " --eye " + at(2.5, 4.5, 9.25) + " --target " + at(0, 1, 0) + " "; }

private:
    struct Point {
        double x, y, z;
    };

    static std::string text(double v) {
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%.17g", v);
        return buffer;
    }
    std::string at(double x, double y, double z) const {
        return text(x_ + scale_ * x) + "," + text(y_ + scale_ * y) + "," + text(z_ + scale_ * z);
    }

    void quad(const Point& a, const Point& b, const Point& c, const Point& d) {
        for (const Point& p : {a, b, c, d}) {
            std::string line = at(p.x, p.y, p.z);
            std::replace(line.begin(), line.end(), ',', ' ');
            obj_ += "v " + line + "\n";
        }
        obj_ += "f -4 -3 -2 -1\n";
    }
    void box(double x0, double y0, double z0, double x1, double y1, double z1) {
        quad({x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1}, {x1, y1, z0});
        quad({x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1});
        quad({x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1});
        quad({x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}, {x1, y0, z0});
        quad({x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, {x0, y1, z0});
        quad({x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1});
    }

    double scale_, x_, y_, z_;
    std::string obj_, library_;
};

float largest_difference(const glm::vec3& a, const glm::vec3& b) {
    float difference = 0.0f;
    for (int c = 0; c < 3; ++c) difference = std::max(difference, std::abs(a[c] - b[c]));
    return difference;
}

class Invariance : public Programs {
protected:
    render::Picture picture_of(const Courtyard& yard) {
        folder.write("yard.obj", yard.obj());
        folder.write("yard.mtl", yard.library());
        folder.write("yard.csv", yard.lights());
        const auto done = render("yard.obj" + yard.camera() +
                                 "--lights yard.csv --method exhaustive --area-points 16 --size 96x72 -o p.exr");
        EXPECT_EQ(done.status, 0) << done.err;
        return render::read_exr(folder / "p.exr");
    }

    /// 99.9 % of the pixels agree to 1e-3 of their own brightness; the others lie where the reference has an edge.
    static void expect_same(const render::Picture& picture, const render::Picture& reference) {
        ASSERT_EQ(picture.size(), reference.size());
        std::size_t off = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const auto at = [&](const render::Picture& p, int i, int j) {
                    const int column = std::clamp(i, 0, p.width - 1);
                    const int row = std::clamp(j, 0, p.height - 1);
                    return p.pixels[static_cast<std::size_t>(row * p.width + column)];
                };
                const glm::vec3 wanted = at(reference, x, y);
                const float brightness = std::max({wanted.r, wanted.g, wanted.b});
                if (largest_difference(at(picture, x, y), wanted) <= 1e-3f * brightness) continue;
                ++off;
                float contrast = 0.0f;
                for (int i = -1; i <= 1; ++i) {
                    for (int j = -1; j <= 1; ++j) {
                        contrast = std::max(contrast, largest_difference(at(reference, x + i, y + j), wanted));
                    }
                }
                EXPECT_GT(contrast, 0.01f * brightness) << "no edge at " << x << ", " << y;
            }
        }
        EXPECT_LE(static_cast<double>(off), 0.001 * static_cast<double>(picture.size()));
    }
};

TEST_F(Invariance, UnderTranslation) {
    const render::Picture reference = picture_of({1.0, 0.0, 0.0, 0.0});
    double brightest = 0.0;
    for (const glm::vec3& p : reference.pixels) brightest = std::max(brightest, static_cast<double>(p.r));
    ASSERT_GT(brightest, 0.1);
    for (const double far : {20.0, 1e3, 1e5, 1e6, 4080896.0}) {
        SCOPED_TRACE(far);
        expect_same(picture_of({1.0, far, 0.0, 0.0}), reference);
        expect_same(picture_of({1.0, 0.1 * far - 0.1 * std::fmod(far, 10.0), far, -far}), reference);
    }
}

TEST_F(Invariance, UnderScaling) {
    const render::Picture reference = picture_of({1.0, 0.0, 0.0, 0.0});
    for (const double scale : {1e-6, 1e-3, 0.0254, 1e3, 1e6}) {
        SCOPED_TRACE(scale);
        expect_same(picture_of({scale, 0.0, 0.0, 0.0}), reference);
        expect_same(picture_of({scale, 100.0 * scale, 0.0, 300.0 * scale}), reference);
    }
}

}  // namespace
