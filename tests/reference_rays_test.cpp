// Tests of the reference ray caster: closed forms, grazing rays, poles, and agreement with a dense tessellation.
#include "picture.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace tessera::reference {
namespace {

constexpr std::array<std::array<double, 4>, 3> power{{{1, 1, 1, 1}, {0, 1.0 / 3, 2.0 / 3, 1}, {0, 0, 1.0 / 3, 1}}};

// The graph z = x^2 + y^2 over 0 <= x, y <= 3: coefficients are exact in single precision.
Mesh paraboloid() {
    Mesh mesh{"mesh0", PatchKind::bezier, {}};
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) mesh.points.emplace_back(3 * power[1][i], 3 * power[1][j], 9 * (power[2][i] + power[2][j]));
    for (glm::vec3& point : mesh.points) point = glm::round(point);
    return mesh;
}

// What algebra says: the first root, beyond tMin, of a ray with the paraboloid over its domain.
std::optional<double> firstRoot(const Ray& ray, double tMin, double& margin) {
    const glm::dvec3& o = ray.origin;
    const glm::dvec3& d = ray.direction;
    const double a = d.x * d.x + d.y * d.y;
    const double b = 2 * (o.x * d.x + o.y * d.y) - d.z;
    const double c = o.x * o.x + o.y * o.y - o.z;
    const double discriminant = b * b - 4 * a * c;
    margin = std::abs(discriminant) / (b * b);
    if (discriminant < 0) return std::nullopt;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    std::array<double, 2> roots{q / a, c / q};
    std::sort(roots.begin(), roots.end());
    for (const double t : roots) {
        const glm::dvec3 p = o + t * d;
        margin = std::min({margin, std::abs(p.x), std::abs(p.y), std::abs(p.x - 3), std::abs(p.y - 3)});
        if (t > tMin && p.x >= 0 && p.x <= 3 && p.y >= 0 && p.y <= 3) return t;
    }
    return std::nullopt;
}

// Of the same graph, two triangles that meet along x + y = 3, the second one turned.
Mesh paraboloidOfTriangles() {
    Mesh mesh{"mesh0", PatchKind::pn, {}};
    for (const bool turned : {false, true}) {
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i + j < 4; ++i) {
                const int x = turned ? 3 - i : i;
                const int y = turned ? 3 - j : j;
                mesh.points.emplace_back(x, y, 1.5 * (x * (x - 1) + y * (y - 1)));
            }
        }
        mesh.points.insert(mesh.points.end(), 6, glm::vec3(0, 0, 1));
    }
    return mesh;
}

// With weights that only move the parameters.
Mesh weightedParaboloid() {
    Mesh mesh = paraboloid();
    mesh.kind = PatchKind::rational;
    for (std::size_t i = 0; i < 16; ++i) mesh.weights.push_back(std::ldexp(1.0F, static_cast<int>(i % 4) - static_cast<int>(i / 4)));
    return mesh;
}

// Where (u, v) of a hit stands under the graph.
glm::dvec2 under(PatchKind kind, const Hit& hit) {
    const glm::dvec2 at(hit.u, hit.v);
    if (kind == PatchKind::pn) return hit.patch == 0 ? 3.0 * at : 3.0 - 3.0 * at;
    if (kind == PatchKind::bezier) return 3.0 * at;
    return {3 * 2 * at.x / (1 + at.x), 3 * 0.5 * at.y / (1 - 0.5 * at.y)};
}

Mesh paraboloidOf(PatchKind kind) {
    if (kind == PatchKind::bezier) return paraboloid();
    return kind == PatchKind::pn ? paraboloidOfTriangles() : weightedParaboloid();
}

class ReferenceParaboloid : public ::testing::TestWithParam<PatchKind> {};

TEST_P(ReferenceParaboloid, IsMetWhereAlgebraSays) {
    const RayCaster caster(sceneOf({paraboloidOf(GetParam())}));
    Random random(4);
    int hits = 0;
    for (int k = 0; k < 20000; ++k) {
        const glm::dvec3 target(random.between(-0.5, 3.5), random.between(-0.5, 3.5), random.between(-1, 19));
        const glm::dvec3 origin = glm::dvec3(1.5, 1.5, 9) + random.inCube(40.0);
        const Ray ray{origin, target - origin};
        double margin = 0.0;
        const std::optional<double> expected = firstRoot(ray, 0.0, margin);
        if (margin < 1e-9) continue;
        const std::optional<Hit> hit = caster.cast(ray, 0.0);
        ASSERT_EQ(hit.has_value(), expected.has_value()) << k;
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->t, *expected, 1e-8);
        EXPECT_NEAR(under(GetParam(), *hit).x, hit->point.x, 1e-12);
        EXPECT_NEAR(under(GetParam(), *hit).y, hit->point.y, 1e-12);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-2 * hit->point.x, -2 * hit->point.y, 1));
        EXPECT_GT(glm::dot(hit->normal, normal), 1 - 1e-12);
        const glm::dvec3 shading = GetParam() == PatchKind::pn ? glm::dvec3(0, 0, 1) : normal;
        EXPECT_GT(glm::dot(hit->shadingNormal, shading), 1 - 1e-12);
    }
    EXPECT_GT(hits, 5000);
}

INSTANTIATE_TEST_SUITE_P(ReferenceRays, ReferenceParaboloid, ::testing::Values(PatchKind::bezier, PatchKind::rational, PatchKind::pn),
                         [](const auto& kind) {
                             if (kind.param == PatchKind::bezier) return "bezier";
                             return kind.param == PatchKind::pn ? "pn" : "rational";
                         });

// Through points of the border between two triangles, and beside it by less than rounding can tell.
TEST(ReferenceRays, AlwaysMeetTheBorderOfTwoTriangles) {
    const RayCaster caster(sceneOf({paraboloidOfTriangles()}));
    Random random(6);
    for (int k = 0; k < 3000; ++k) {
        const double x = k % 4 == 0 ? 0.375 * (k / 4 % 9) : random.between(0, 3);
        const double aside = k % 3 == 0 ? 0.0 : random.between(-1, 1) * std::pow(10.0, random.between(-17, -11));
        const glm::dvec3 target(x, 3 - x + aside, x * x + (3 - x) * (3 - x));
        const glm::dvec3 origin = target + glm::dvec3(random.between(-3, 3), random.between(-3, 3), 9);
        EXPECT_TRUE(caster.cast({origin, target - origin}, 0.5, 1.5).has_value()) << x << " " << aside;
    }
}

// A triangle's polynomial goes on beyond its third border; the triangle does not.
TEST(ReferenceRays, MissATriangleBeyondItsThirdBorder) {
    Mesh one = paraboloidOfTriangles();
    one.points.resize(16);
    const RayCaster caster(sceneOf({one}));
    Random random(7);
    for (int k = 0; k < 500; ++k) {
        const double x = random.between(0, 3);
        const double aside = std::pow(10.0, random.between(-6, -1));
        EXPECT_TRUE(caster.cast({{x, 3 - x - aside, 30}, {0, 0, -1}}, 0.0).has_value() || x + aside > 3) << x << " " << aside;
        EXPECT_FALSE(caster.cast({{x, 3 - x + aside, 30}, {0, 0, -1}}, 0.0).has_value()) << x << " " << aside;
    }
}

// Rays along a tangent, lifted to either side: over the bowl's inside they meet nothing near, below it they meet it twice.
TEST(ReferenceRays, GrazeASilhouetteOnTheRightSide) {
    const RayCaster caster(sceneOf({paraboloid()}));
    Random random(5);
    for (const double lift : {1e-2, 1e-4, 1e-6, 1e-8}) {
        for (int k = 0; k < 100; ++k) {
            const glm::dvec3 p(random.between(1, 2), random.between(1, 2), 0.0);
            const glm::dvec3 touch(p.x, p.y, p.x * p.x + p.y * p.y);
            const double angle = random.between(0, 2 * std::numbers::pi);
            const glm::dvec3 along(std::cos(angle), std::sin(angle), 2 * (p.x * std::cos(angle) + p.y * std::sin(angle)));
            const glm::dvec3 start = touch - 20.0 * along;
            EXPECT_FALSE(caster.cast({start - glm::dvec3(0, 0, lift), along}, 0.0).has_value()) << lift;
            const std::optional<Hit> hit = caster.cast({start + glm::dvec3(0, 0, lift), along}, 0.0);
            ASSERT_TRUE(hit.has_value()) << lift;
            EXPECT_NEAR(hit->t, 20.0 - std::sqrt(lift), 1e-5 * std::sqrt(lift) + 1e-9 / std::sqrt(lift));
        }
    }
}

// A quarter of a bowl around its lowest point, where a whole row of the net is one point.
TEST(ReferenceRays, MeetAPole) {
    const std::array<glm::dvec2, 4> arc{glm::dvec2(1, 0), {1, 0.5625}, {0.5625, 1}, {0, 1}};
    Mesh mesh;
    for (std::size_t j = 0; j < 4; ++j)
        for (const glm::dvec2& a : arc) mesh.points.emplace_back(power[1][j] * a, power[2][j]);
    const RayCaster caster(sceneOf({mesh}));
    const glm::dvec3 eye(1, 2, 8);
    for (const double inset : {0.0, 1e-12, 1e-8, 1e-4, 1e-2}) {
        const glm::dvec3 target(inset, inset, 0.0);
        const std::optional<Hit> hit = caster.cast({eye, target - eye}, 0.0);
        ASSERT_TRUE(hit.has_value()) << inset;
        EXPECT_LE(hit->residual, 1e-10 * caster.sceneSize());
        EXPECT_LE(glm::length(hit->point - target), 3 * inset * inset + 1e-9);
        EXPECT_GT(-hit->normal.z, 1 - 1e-3) << inset;
    }
    EXPECT_FALSE(caster.cast({eye, glm::dvec3(-1e-4, -1e-4, 0.0) - eye}, 0.0).has_value());
}

// The same patches as Bezier and as Gregory, and truly rational ones, seen from somewhere.
struct Sample {
    Scene scene;
    Camera camera;
};

std::vector<Sample> samples() {
    std::vector<Sample> result;
    const std::array<glm::dvec3, 3> eyes{glm::dvec3(0.5, 1, 6), {4, 0.2, -3}, {0.1, 0.3, 0.8}};  // the last one among the patches
    for (std::size_t k = 0; k < eyes.size(); ++k) {
        const Mesh bezier = bumpyBezierMesh(20 + k, 6);
        const Mesh gregory = parted(asGregory(bumpyBezierMesh(30 + k, 6)), 0.25, 40 + k);
        const Mesh rational = weighted(bumpyBezierMesh(60 + k, 3), 1.5, 70 + k);
        result.push_back({sceneOf({bezier, gregory, rational, bumpyPnMesh(80 + k, 4)}), cameraAt(eyes[k], {0, 0, 0}, k < 2 ? 28 : 60)});
    }
    return result;
}

TEST(ReferenceRays, HitsProjectBackOntoTheirPixels) {
    for (const Sample& sample : samples()) {
        const RayCaster caster(sample.scene);
        const View view(sample.camera, 80, 45);
        const Picture picture = castPicture(caster, view);
        for (int y = 0; y < 45; ++y) {
            for (int x = 0; x < 80; ++x) {
                const Pixel& pixel = picture.at(x, y);
                if (!pixel.covered) continue;
                const glm::dvec3 back = view.project(pixel.hit.point);
                EXPECT_LE(pixel.hit.residual, 1e-9 * caster.sceneSize());
                EXPECT_NEAR(back.x, x + 0.5, 1e-6);
                EXPECT_NEAR(back.y, y + 0.5, 1e-6);
                EXPECT_NEAR(back.z, pixel.z, 1e-8);
                EXPECT_GT(pixel.z, view.near());
                EXPECT_LE(glm::dot(pixel.normal, view.ray(x + 0.5, y + 0.5).direction), 0.0);
                const Mesh& mesh = sample.scene.meshes[pixel.hit.object];
                const std::size_t patch = pixel.hit.patch;
                const glm::dvec3 onPatch =
                    evaluate(mesh.kind, patchPoints(mesh, patch), pixel.hit.u, pixel.hit.v, patchWeights(mesh, patch)).position;
                EXPECT_LE(glm::length(onPatch - pixel.hit.point), 1e-12);
            }
        }
    }
}

TEST(ReferenceRays, SeeTheSameOnBezierPatchesAndTheirGregoryForm) {
    const Mesh bezier = bumpyBezierMesh(50, 8);
    const View view(cameraAt({0.5, 1, 6}, {0, 0, 0}, 40), 80, 45);
    const Picture a = castPicture(RayCaster(sceneOf({bezier})), view);
    const Picture b = castPicture(RayCaster(sceneOf({asGregory(bezier)})), view);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        ASSERT_EQ(a.pixels[i].covered, b.pixels[i].covered);
        if (!a.pixels[i].covered) continue;
        EXPECT_NEAR(a.pixels[i].z, b.pixels[i].z, 1e-8);
        EXPECT_EQ(a.pixels[i].hit.patch, b.pixels[i].hit.patch);
    }
}

TEST(ReferenceRays, NearPlaneUncoversWhatIsBehind) {
    const Sample sample = samples()[0];
    const RayCaster caster(sample.scene);
    const View view(sample.camera, 40, 22);
    int layers = 0;
    for (int y = 0; y < 22; ++y) {
        for (int x = 0; x < 40; ++x) {
            const Ray ray = view.ray(x + 0.5, y + 0.5);
            double before = 0.0;
            while (const std::optional<Hit> hit = caster.cast(ray, before + 1e-6)) {
                ASSERT_GT(hit->t, before);
                before = hit->t;
                ++layers;
            }
            EXPECT_FALSE(caster.cast(ray, 0.0, 1e-3).has_value());
        }
    }
    EXPECT_GT(layers, 500);
}

TEST(ReferenceRays, ObjectsStandWhereTheirTransformsPutThem) {
    // Half a turn about the diagonal x = y, z = 0 exchanges x and y and turns z round; the quaternion is not of unit length.
    for (const PatchKind kind : {PatchKind::bezier, PatchKind::rational, PatchKind::pn}) {
        Scene scene = sceneOf({paraboloidOf(kind)});
        scene.objects[0].transform.rotation = glm::quat(0.0F, 3.0F, 3.0F, 0.0F);
        scene.objects[0].transform.translation = {10, 0, 0};
        const std::optional<Hit> hit = RayCaster(scene).cast({{10 + 0.5, 2, -30}, {0, 0, 2}}, 0.0);
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(hit->t, (30 - 4.25) / 2, 1e-9);
        EXPECT_NEAR(under(kind, *hit).x, 2.0, 1e-9);
        EXPECT_NEAR(under(kind, *hit).y, 0.5, 1e-9);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-1, -4, -1));
        EXPECT_GT(glm::dot(hit->normal, normal), 1 - 1e-12);
        EXPECT_GT(glm::dot(hit->shadingNormal, kind == PatchKind::pn ? glm::dvec3(0, 0, -1) : normal), 1 - 1e-12);
    }
}

// Depth at every pixel's centre of a tessellation into triangles.
constexpr int fine = 96;

class DepthBuffer {
public:
    explicit DepthBuffer(const View& view)
        : view_(view), z_(static_cast<std::size_t>(view.width() * view.height()), std::numeric_limits<double>::infinity()) {}

    void draw(const Mesh& mesh) {
        for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
            const std::vector<glm::dvec3> points = patchPoints(mesh, patch);
            const std::vector<double> weights = patchWeights(mesh, patch);
            const auto at = [&](int i, int j) {
                const double step = 1.0 / fine;
                return view_.project(evaluate(mesh.kind, points, i * step, j * step, weights).position);
            };
            for (int j = 0; j < fine; ++j) {
                const int end = mesh.kind == PatchKind::pn ? fine - j : fine;
                for (int i = 0; i < end; ++i) {
                    triangle(at(i, j), at(i + 1, j), at(i, j + 1));
                    if (mesh.kind != PatchKind::pn || i + 1 < end) triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
            }
        }
    }
    [[nodiscard]] double at(int x, int y) const { return z_[index(x, y)]; }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width()) + static_cast<std::size_t>(x);
    }
    static double side(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    }
    void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const int x1 = static_cast<int>(std::min<double>(view_.width(), std::max({a.x, b.x, c.x}) + 1));
        const int y1 = static_cast<int>(std::min<double>(view_.height(), std::max({a.y, b.y, c.y}) + 1));
        for (int y = static_cast<int>(std::max(0.0, std::min({a.y, b.y, c.y}))); y < y1; ++y)
            for (int x = static_cast<int>(std::max(0.0, std::min({a.x, b.x, c.x}))); x < x1; ++x) point(a, b, c, x, y);
    }
    void point(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int x, int y) {
        const glm::dvec3 w(side(b, c, x + 0.5, y + 0.5), side(c, a, x + 0.5, y + 0.5), side(a, b, x + 0.5, y + 0.5));
        const double sum = w.x + w.y + w.z;
        if (sum == 0 || w.x * sum < 0 || w.y * sum < 0 || w.z * sum < 0) return;
        double& z = z_[index(x, y)];
        z = std::min(z, sum / (w.x / a.z + w.y / b.z + w.z / c.z));
    }

    View view_;
    std::vector<double> z_;
};

bool sameAround(const Picture& picture, int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (picture.at(x + dx, y + dy).covered != picture.at(x, y).covered) return false;
    return true;
}

// A triangle leaves the surface by at most an eighth of h^2 (|Suu| + 2 |Suv| + |Svv|), h = 1/96. The net's steps are below 1.1 + 2
// x 0.55, its second differences below 4 x 0.55 along the axes: second derivatives are below 6 x 2.2 = 13 (and Gregory's add at
// most 4 x 18 x 0.45): 5e-4 for Bezier, 2e-3 in all, which holds what weights of 2/3 to 3/2 add (measured). Along the ray that grows by one
// over the cosine between ray and normal.
TEST(ReferenceRays, AgreeWithADenseTessellation) {
    const double leave = 2e-3;
    for (std::size_t k = 0; k < 2; ++k) {
        const Sample sample = samples()[k];
        const View view(sample.camera, 160, 90);
        const Picture picture = castPicture(RayCaster(sample.scene), view);
        DepthBuffer buffer(view);
        for (const Mesh& mesh : sample.scene.meshes) buffer.draw(mesh);
        int compared = 0;
        for (int y = 1; y < 89; ++y) {
            for (int x = 1; x < 159; ++x) {
                if (!sameAround(picture, x, y)) continue;
                const Pixel& pixel = picture.at(x, y);
                ASSERT_EQ(pixel.covered, std::isfinite(buffer.at(x, y))) << x << " " << y;
                const double cosine = -glm::dot(pixel.normal, glm::normalize(view.ray(x + 0.5, y + 0.5).direction));
                if (!pixel.covered || cosine < 0.2) continue;
                // Silhouettes in front of other patches may hide or show a pixel's nearer surface.
                bool edge = false;
                for (int d = 0; d < 9; ++d) edge = edge || std::abs(picture.at(x + d % 3 - 1, y + d / 3 - 1).z - pixel.z) > 0.2;
                if (edge) continue;
                EXPECT_NEAR(pixel.z, buffer.at(x, y), leave / cosine) << x << " " << y;
                ++compared;
            }
        }
        EXPECT_GT(compared, 1500);
    }
}

}  // namespace
}  // namespace tessera::reference
