#include <array>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "archetypes/archetypes.hpp"

// Each type lacks one thing that its concept asks for, and no more; the archetypes beside them lack nothing.
namespace lightcuts::test {
namespace knock_out {

// Vector3
struct TwoCoordinates {
    float x, y;
};
struct WordCoordinates {
    std::string x, y, z;
};
static_assert(Vector3<OwnVector> && Vector3<glm::vec3>);
static_assert(!Vector3<TwoCoordinates> && !Vector3<WordCoordinates> && !Vector3<float>);

// Spectrum
struct Bare {
    static constexpr int channels = 2;
    float operator[](int) const { return 0.0f; }
    float& operator[](int) {
        static float f;
        return f;
    }
};
struct NoSum : Bare {
    friend NoSum operator*(const NoSum& a, const NoSum&) { return a; }
    friend NoSum operator*(const NoSum& a, float) { return a; }
};
struct NoProduct : Bare {
    friend NoProduct operator+(const NoProduct& a, const NoProduct&) { return a; }
    friend NoProduct operator*(const NoProduct& a, float) { return a; }
};
struct NoScale : Bare {
    friend NoScale operator+(const NoScale& a, const NoScale&) { return a; }
    friend NoScale operator*(const NoScale& a, const NoScale&) { return a; }
};
struct NoChannels {
    float operator[](int) const { return 0.0f; }
    friend NoChannels operator+(const NoChannels& a, const NoChannels&) { return a; }
    friend NoChannels operator*(const NoChannels& a, const NoChannels&) { return a; }
    friend NoChannels operator*(const NoChannels& a, float) { return a; }
};
struct NoDefault : Bare {
    explicit NoDefault(int) {}
    friend NoDefault operator+(const NoDefault& a, const NoDefault&) { return a; }
    friend NoDefault operator*(const NoDefault& a, const NoDefault&) { return a; }
    friend NoDefault operator*(const NoDefault& a, float) { return a; }
};
struct NoAssignment : Bare {
    NoAssignment() = default;
    NoAssignment(const NoAssignment&) = default;
    NoAssignment& operator=(const NoAssignment&) = delete;
    friend NoAssignment operator+(const NoAssignment& a, const NoAssignment&) { return a; }
    friend NoAssignment operator*(const NoAssignment& a, const NoAssignment&) { return a; }
    friend NoAssignment operator*(const NoAssignment& a, float) { return a; }
};
static_assert(Spectrum<Bands> && Spectrum<Unset> && Spectrum<float> && Spectrum<double> && Spectrum<glm::vec3>);
static_assert(!Spectrum<NoSum> && !Spectrum<NoProduct> && !Spectrum<NoScale> && !Spectrum<NoChannels> &&
              !Spectrum<NoDefault> && !Spectrum<NoAssignment>);
static_assert(!Spectrum<int> && !Spectrum<std::string>);

// Light
struct NoIntensity {
    glm::vec3 position;
};
struct NoPlace {
    float intensity;
};
struct PlaceOfWords {
    std::string position;
    float intensity;
};
struct IntensityOfWords {
    glm::vec3 position;
    std::string intensity;
};
/// Its functions may not be called on a constant light.
struct Mutable {
    glm::vec3 position() { return {}; }
    float intensity() { return 0.0f; }
};
/// With both, it is a point light: a direction is not an axis.
struct Both {
    glm::vec3 position, direction;
    float intensity;
};
struct NoAxis {
    glm::vec3 position;
    float intensity;
    float emission(float) const { return 1.0f; }
};
struct EmissionOfWords {
    glm::vec3 position, axis;
    float intensity;
    float emission(const std::string&) const { return 1.0f; }
};
static_assert(PointLight<LeastLight> && !OrientedLight<LeastLight> && !FalloffLight<LeastLight> &&
              !DirectionalLight<LeastLight>);
static_assert(ProfiledLight<ForeignLight> && FalloffLight<ForeignLight>);
static_assert(DirectionalLight<LeastSun> && !PointLight<LeastSun>);
static_assert(!Light<NoIntensity> && !Light<NoPlace> && !Light<PlaceOfWords> && !Light<IntensityOfWords> &&
              !Light<Mutable>);
static_assert(PointLight<Both> && !DirectionalLight<Both> && !OrientedLight<Both>);
static_assert(PointLight<NoAxis> && !ProfiledLight<NoAxis>);
static_assert(OrientedLight<EmissionOfWords> && !ProfiledLight<EmissionOfWords>);

// Material
struct NoEvaluate {
    float upper_bound(const OffsetBox&) const { return 1.0f; }
};
struct NoBound {
    float evaluate(const glm::vec3&) const { return 1.0f; }
};
struct BoundOfOtherSpectrum {
    float evaluate(const glm::vec3&) const { return 1.0f; }
    glm::vec3 upper_bound(const OffsetBox&) const { return glm::vec3(1.0f); }
};
struct MutableMaterial {
    float evaluate(const glm::vec3&) { return 1.0f; }
};
static_assert(BoundedMaterial<LeastMaterial> && !QuicklyBoundedMaterial<LeastMaterial> &&
              !CosineLobeMaterial<LeastMaterial>);
static_assert(!Material<NoEvaluate> && Material<NoBound> && !BoundedMaterial<NoBound> &&
              !BoundedMaterial<BoundOfOtherSpectrum>);
static_assert(!Material<MutableMaterial>);

// Bounds of many surfaces
struct LeastLobe {
    CosineLobe<Bands, Cone> cosine_lobe() const { return {cone_of({0.0f, 0.0f, 1.0f}), black<Bands>()}; }
};
struct LobeOfOtherSpectrum {
    CosineLobe<glm::vec3> cosine_lobe() const { return {{0.0f, 0.0f, 1.0f}, glm::vec3(1.0f)}; }
};
struct LeastBound {
    Bands upper_bound(const OffsetBox&) const { return black<Bands>(); }
};
struct LeastParts {
    template <class F>
    void for_each_component(F&& f) const {
        f(LeastLobe{});
        f(LeastBound{});
    }
};
static_assert(ReflectionBound<LeastLobe, Bands> && ReflectionBound<LeastBound, Bands> &&
              ReflectionBound<LeastParts, Bands> && ReflectionBound<LeastMaterial, Bands>);
static_assert(!ReflectionBound<LobeOfOtherSpectrum, Bands> && !ReflectionBound<LeastBound, glm::vec3> &&
              !ReflectionBound<NoBound, Bands> && !Material<LeastLobe>);
static_assert(BoundPolicy<TwoStageBounds, LeastParts, LightCluster<LeastLight>> &&
              BoundPolicy<SeparateBounds, LeastParts, LightCluster<LeastLight>>);

// Oracles
using R = Receiver<const LeastMaterial&>;
struct NoAnswer {
    void operator()(const R&, const LeastLight&) const {}
};
struct OtherLight {
    bool operator()(const R&, const LeastSun&) const { return true; }
};
struct ManyWithoutAnswers {
    void many(std::span<const VisibilityQuery>) const {}
};
struct MutableMany {
    void many(std::span<const VisibilityQuery>, std::span<float>) {}
};
struct OtherSpectrum {
    glm::vec3 operator()(const R&, const LeastLight&) const { return {}; }
    void many(std::span<const VisibilityQuery>, std::span<glm::vec3>) const {}
};
struct LikelihoodOfWords {
    std::string operator()(std::uint32_t, std::uint32_t) const { return {}; }
};
struct MutableLikelihood {
    float operator()(std::uint32_t, std::uint32_t) { return 1.0f; }
};
template <class Likelihood>
struct Predicts : LeastOracle {
    Likelihood likely_visible(const R&) const { return {}; }
};
struct PredictsWhenMutable : LeastOracle {
    LeastLikelihood likely_visible(const R&) { return {}; }
};
static_assert(PredictingOracle<LeastPredictingOracle, R> && PredictingOracle<LeastBatchedPredictingOracle, R> &&
              PredictingOracle<Predicts<LeastLikelihood>, R>);
static_assert(!PredictingOracle<Predicts<LikelihoodOfWords>, R> && !PredictingOracle<Predicts<MutableLikelihood>, R> &&
              !PredictingOracle<Predicts<float>, R> && !PredictingOracle<PredictsWhenMutable, R> &&
              !PredictingOracle<LeastOracle, R>);
static_assert(ScalarOracle<LeastTint, R, LeastLight> && VisibilityOracle<LeastTint, R, LeastLight>);
static_assert(TintingOracle<LeastTintingOracle, Bands> && VisibilityOracle<LeastTintingOracle, R, LeastLight>);
static_assert(!TintingOracle<LeastTint, Bands> && !BatchedOracle<LeastTintingOracle>);
static_assert(!VisibilityOracle<OtherSpectrum, R, LeastLight>);
static_assert(ScalarOracle<LeastOracle, R, LeastLight> && !BatchedOracle<LeastOracle>);
static_assert(BatchedOracle<LeastBatchedOracle> && !ScalarOracle<LeastBatchedOracle, R, LeastLight>);
static_assert(!VisibilityOracle<NoAnswer, R, LeastLight> && !VisibilityOracle<OtherLight, R, LeastLight>);
static_assert(!VisibilityOracle<ManyWithoutAnswers, R, LeastLight> && !VisibilityOracle<MutableMany, R, LeastLight>);

// Two-sided materials
struct Forgetful : LeastMaterial {
    void is_behind(const glm::vec3&) const {}
};
static_assert(TwoSidedMaterial<LeastLeaf> && !TwoSidedMaterial<LeastMaterial> && !TwoSidedMaterial<Forgetful>);

// Policies
struct NoQuick {
    static constexpr bool two_stages = false;
};
static_assert(BoundPolicy<LeastPolicy, LeastMaterial, LightCluster<LeastLight>>);
static_assert(!BoundPolicy<NoQuick, LeastMaterial, LightCluster<LeastLight>>);

// Refinement problems
struct LeastProblem {
    using Node = int;
    void roots(ReusableList<int>& out) { out.append(1); }
    void evaluate(std::span<int>) {}
    double priority(int) const { return 0.0; }
    double threshold() const { return 1.0; }
    void split(int, ReusableList<int>&) {}
    bool precedes(int a, int b) const { return a < b; }
};
struct NoPrecedes : LeastProblem {
    void precedes() const {}
};
struct NoThreshold : LeastProblem {
    void threshold(int) const {}
};
static_assert(RefinementProblem<LeastProblem>);
static_assert(!RefinementProblem<NoPrecedes> && !RefinementProblem<NoThreshold>);

// Executors
struct NoCount {
    template <class Task>
    void operator()(Task&&) const {}
};
struct MutableExecutor {
    template <class Task>
    void operator()(std::size_t, Task&&) {}
};
static_assert(!Executor<NoCount> && !Executor<MutableExecutor>);

// Forests
template <class... Ls>
concept Forested = requires {
    typename LightForest<Ls...>;
};
static_assert(Forested<LeastLight, LeastSun> && !Forested<> && !Forested<NoPlace>);

TEST(Archetype, OfARefinementProblemRuns) {
    LeastProblem problem;
    Refinement<int> refinement;
    refinement.run(problem, {});
    EXPECT_EQ(refinement.size(), 1u);
}

}  // namespace knock_out
}  // namespace lightcuts::test
