#include "animation/playback/inertial_blend.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "support/catch.hpp"

using namespace lutka;
using animation::InertialBlend;

namespace {

constexpr float kStep = 1.0F / 60.0F;

// A frame that turns and moves evenly.
struct EvenMotion {
    vec3 axis{0, 0, 1};
    float start = 0.0F;  // radians
    float rate = 0.0F;
    vec3 velocity{0, 0, 0};
    [[nodiscard]] std::array<RigidTransform, 1> at(float seconds) const {
        return {RigidTransform{glm::angleAxis(start + rate * seconds, axis), velocity * seconds}};
    }
};

float angleBetween(const RigidTransform& a, const RigidTransform& b) {
    return glm::length(rotationVector(glm::normalize(a.rotation * glm::conjugate(b.rotation))));
}

// The most that the speed of a turn changes by from step to step, rad/s, over `seconds` of a blend that begins at 0.
struct Course {
    float mostJump = 0.0F;
    float mostStep = 0.0F;
    RigidTransform end;
};
Course courseOf(InertialBlend& blend, const EvenMotion& to, RigidTransform before, RigidTransform shown,
                float seconds) {
    Course course;
    vec3 rate = rotationVector(glm::normalize(shown.rotation * glm::conjugate(before.rotation))) / kStep;
    for (float t = kStep; t <= seconds; t += kStep) {
        auto frame = to.at(t);
        blend.advance(kStep);
        blend.apply(frame);
        const vec3 next = rotationVector(glm::normalize(frame[0].rotation * glm::conjugate(shown.rotation))) / kStep;
        course.mostJump = std::max(course.mostJump, glm::length(next - rate));
        course.mostStep = std::max(course.mostStep, angleBetween(frame[0], shown));
        rate = next;
        shown = frame[0];
    }
    course.end = shown;
    return course;
}

}  // namespace

TEST_CASE("a blend goes over without a jump in place or velocity and ends in the other motion") {
    const EvenMotion from{{0, 0, 1}, 1.2F, 2.0F, {1, 0, 0}};
    const EvenMotion to{glm::normalize(vec3(1, 2, 0)), -0.6F, 0.5F, {0, 0, 0.3F}};
    InertialBlend blend;
    blend.begin(from.at(-kStep), from.at(0), to.at(-kStep), to.at(0), kStep);
    auto first = to.at(0);
    blend.apply(first);
    CHECK(angleBetween(first[0], from.at(0)[0]) < 1e-3F);
    CHECK(glm::distance(first[0].translation, from.at(0)[0].translation) < 1e-5F);
    const Course course = courseOf(blend, to, from.at(-kStep)[0], from.at(0)[0], blend.seconds() + 0.1F);
    CHECK(course.mostJump < 1.0F);  // rad/s a step; the two motions differ by 2.3
    CHECK(blend.isOver());
    CHECK(blend.share() == 1.0F);
    // What is shown is the motion itself now.
    auto late = to.at(3.0F);
    blend.apply(late);
    CHECK(late[0].rotation == to.at(3.0F)[0].rotation);
}

TEST_CASE("a blend that is begun anew on its way shows no jump either") {
    const EvenMotion from{{0, 0, 1}, 2.0F, 0.0F};
    const EvenMotion first{{0, 1, 0}, 0.0F, 1.0F};
    const EvenMotion second{{1, 0, 0}, 1.5F, -1.0F};
    InertialBlend blend;
    blend.begin(from.at(-kStep), from.at(0), first.at(-kStep), first.at(0), kStep);
    const Course half = courseOf(blend, first, from.at(-kStep)[0], from.at(0)[0], 0.5F * blend.seconds());
    InertialBlend again = blend;
    const std::array<RigidTransform, 1> now{half.end};
    again.begin(now, now, second.at(-kStep), second.at(0), kStep);
    auto start = second.at(0);
    again.apply(start);
    CHECK(angleBetween(start[0], half.end) < 1e-3F);
}

TEST_CASE("large turns take the time that the rate asks for, up to a bound") {
    const EvenMotion still;
    InertialBlend blend;
    const auto secondsFor = [&](float angle) {
        const EvenMotion from{{0, 0, 1}, angle, 0.0F};
        blend.begin(from.at(0), from.at(0), still.at(0), still.at(0), kStep,
                    {.turnRate = radians(240.0F), .speed = 2.0F, .leastSeconds = 0.2F, .mostSeconds = 1.0F});
        return blend.seconds();
    };
    CHECK(secondsFor(0.01F) == 0.2F);
    CHECK(secondsFor(radians(90.0F)) == Approx(1.875F * 90.0F / 240.0F));
    CHECK(secondsFor(radians(175.0F)) == 1.0F);
    const EvenMotion from{{0, 0, 1}, radians(90.0F), 0.0F};
    static_cast<void>(secondsFor(radians(90.0F)));
    const Course course = courseOf(blend, still, from.at(0)[0], from.at(0)[0], 1.0F);
    CHECK(course.mostStep <= radians(240.0F) * kStep * 1.01F);
}
