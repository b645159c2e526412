#include "physics/doctor/broken_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "core/aabb.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kLeastNear = 0.1F;      // of the skin's vertices near their body, below which …
constexpr float kLeastCovered = 0.12F;  // … with less than this of the volume in some body, the skin is elsewhere
constexpr float kFar = 0.06F;           // of the height: skin farther than that from a body does not hang on it
constexpr float kToCorner = 0.74F;      // of a shape's radius: how far the corner of the box about a ball is
constexpr float kClothed = 0.25F;       // of the shape's surface: skin of its own about it
constexpr float kMostClothed = 0.8F;    // of the bodies
constexpr float kMostFar = 0.5F;        // of the skin's area
constexpr float kMostAtOthers = 0.3F;   // of the skin's area
constexpr float kAtBody = 0.03F;        // of the height from a body: skin there is at it
constexpr float kMostOfOthers = 0.6F;   // of the area of the skin at a body
constexpr std::size_t kManyInOthers = 3;
constexpr double kMostOnOneJoint = 0.9;  // of the skin's weights, where there are …
constexpr std::size_t kManyBodies = 8;   // … so many bodies
constexpr float kSmallSkin = 0.45F;      // of the shape's length: the diagonal of its skin's box
constexpr float kMostSmall = 0.5F;       // of the bodies that have skin
constexpr float kBeside = 0.03F;         // of the height, beyond the box of a body's own skin
constexpr float kLeastSkin = 0.1F;       // of the shape's surface, below which its skin tells nothing
constexpr float kWithin = 0.5F;          // of the body's least half extent, likewise
constexpr float kMostTouching = 0.05F;   // of the skin of a body beside it, within …
constexpr float kTouching = 0.02F;       // … this share of the height of the shape's surface

float areaOf(const PlannedBody& body) {
    float area = 0.0F;
    for (const SkinPoint& point : body.skin)
        area += point.area;
    return area;
}

Finding error(const char* code, std::string place, std::string measure, const char* mend,
              std::vector<std::string> bodies) {
    return {Severity::error, code, std::move(place), std::move(measure), mend, false, std::move(bodies)};
}

// Half the shape's box, in its own axes.
vec3 halfExtents(const PlacedShape& shape) {
    return {halfWidth(shape.shape, {1, 0, 0}), halfWidth(shape.shape, {0, 1, 0}), halfWidth(shape.shape, {0, 0, 1})};
}

// Whether nearly all bodies have skin of their own about them: then what is far is a thing that the figure holds, wears
// or stands in.
bool areClothed(const BodyPlan& plan, std::span<const PlacedShape> shapes) {
    std::size_t clothed = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const RigidTransform bodyFromStandard = inverse(shapes[i].standardFromBody);
        const vec3 half = halfExtents(shapes[i]);
        float near = 0.0F;
        for (const SkinPoint& point : plan.bodies[i].skin) {
            const float distance = std::abs(signedDistance(shapes[i].shape, bodyFromStandard * point.position));
            near += distance <= kTouching * plan.heightM ? point.area : 0.0F;
        }
        const float surface = 8.0F * (half.x * half.y + half.y * half.z + half.z * half.x);
        clothed += near > kClothed * surface ? 1 : 0;
    }
    return static_cast<float>(clothed) >= kMostClothed * static_cast<float>(shapes.size());
}

// Shares of the skin's area.
struct FarSkin {
    float fromAll = 0.0F;   // far from every body
    float atOthers = 0.0F;  // far from the body that moves it, and at one that is no neighbour of that
};

FarSkin findFarSkin(const BodyPlan& plan, std::span<const PlacedShape> shapes) {
    std::vector<RigidTransform> bodyFromStandard;
    std::vector<float> nearEnough;  // of the height
    for (const PlacedShape& shape : shapes) {
        bodyFromStandard.push_back(inverse(shape.standardFromBody));
        const vec3 half = halfExtents(shape);
        nearEnough.push_back(std::max(kFar, kToCorner * std::min({half.x, half.y, half.z}) / plan.heightM));
    }
    float total = 0.0F;
    FarSkin far;
    for (std::size_t own = 0; own < plan.bodies.size(); ++own) {
        for (const SkinPoint& point : plan.bodies[own].skin) {
            const auto distanceTo = [&](std::size_t i) {
                return signedDistance(shapes[i].shape, bodyFromStandard[i] * point.position) / plan.heightM;
            };
            total += point.area;
            if (distanceTo(own) <= nearEnough[own]) continue;
            bool fromAll = true;
            bool elsewhere = false;
            for (std::size_t i = 0; i < shapes.size(); ++i) {
                const float distance = distanceTo(i);
                const bool neighbour =
                    plan.bodies[i].parent == static_cast<int>(own) || plan.bodies[own].parent == static_cast<int>(i);
                fromAll = fromAll && distance > nearEnough[i];
                elsewhere = elsewhere || (!neighbour && distance <= kTouching);
            }
            far.fromAll += fromAll ? point.area : 0.0F;
            far.atOthers += elsewhere ? point.area : 0.0F;
        }
    }
    if (total <= 0.0F) return {};
    return {far.fromAll / total, far.atOthers / total};
}

void findSkinElsewhere(const BodyPlan& plan, std::span<const PlacedShape> shapes, const FitMeasures& fit,
                       std::vector<Finding>& findings) {
    constexpr const char* kMend =
        "look at the bodies on the skin: the map, the skin's weights or the bind pose are wrong";
    if (fit.vertices == 0) return;
    const FarSkin far = findFarSkin(plan, shapes);
    if (far.fromAll > kMostFar && areClothed(plan, shapes)) return;
    if (far.fromAll > kMostFar) {
        findings.push_back(error("skin-outside-bodies", "/bodies",
                                 fmt::format("{:.0f} % of the skin is more than {:.0f} % of the height from all bodies",
                                             100.0F * far.fromAll, 100.0F * kFar),
                                 kMend, {}));
    } else if (far.atOthers > kMostAtOthers) {
        findings.push_back(
            error("skin-outside-bodies", "/bodies",
                  fmt::format("{:.0f} % of the skin lies at bodies of other parts than the one that moves it",
                              100.0F * far.atOthers),
                  "give the skin weights on the joints that it lies at", {}));
    } else if (fit.volumeCovered && fit.skinNear < kLeastNear && *fit.volumeCovered < kLeastCovered) {
        findings.push_back(error("skin-outside-bodies", "/bodies",
                                 fmt::format("{:.0f} % of the skin is near its body and {:.0f} % of the volume in one",
                                             100.0F * fit.skinNear, 100.0F * *fit.volumeCovered),
                                 kMend, {}));
    }
}

// Whether most of the skin at a body is moved by bodies that are not linked with it.
bool isInSkinOfOthers(const BodyPlan& plan, const PlacedShape& shape, std::size_t body) {
    const RigidTransform bodyFromStandard = inverse(shape.standardFromBody);
    float all = 0.0F;
    float others = 0.0F;
    for (std::size_t own = 0; own < plan.bodies.size(); ++own) {
        const bool linked = own == body || plan.bodies[body].parent == static_cast<int>(own) ||
                            plan.bodies[own].parent == static_cast<int>(body);
        for (const SkinPoint& point : plan.bodies[own].skin) {
            if (signedDistance(shape.shape, bodyFromStandard * point.position) > kAtBody * plan.heightM) continue;
            all += point.area;
            others += linked ? 0.0F : point.area;
        }
    }
    return others > kMostOfOthers * all;
}

// Arms or legs whose skin follows the trunk stay where they are as their bodies fall. Of 454 sound public figures one
// has two such bodies, none more; among a creature's many parts others may well lie at hand.
void findBodiesInSkinOfOthers(const BodyPlan& plan, std::span<const PlacedShape> shapes,
                              std::vector<Finding>& findings) {
    if (plan.bodies.size() < kManyBodies) return;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (plan.bodies[i].role && isInSkinOfOthers(plan, shapes[i], i)) names.push_back(plan.bodies[i].name);
    }
    if (names.size() < kManyInOthers) return;
    findings.push_back(
        error("skin-of-others", "/bodies",
              fmt::format("the skin at {} bodies follows other parts: {}", names.size(), fmt::join(names, ", ")),
              "give the skin weights on the joints that it lies at", {}));
}

// By the weights: the fit itself parts the skin of a trunk among its bodies by height. A dense sword in the hand of a
// figure with a skin is no skin.
void findSkinOnOneJoint(const animation::Character& character, const BodyPlan& plan, std::vector<Finding>& findings) {
    if (plan.bodies.size() < kManyBodies) return;
    std::vector<double> weights(character.skeleton.names.size(), 0.0);
    double total = 0.0;
    const bool skinned = std::any_of(character.meshes.begin(), character.meshes.end(),
                                     [](const animation::SkinnedMesh& mesh) { return !mesh.rigid; });
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        if (skinned && mesh.rigid) continue;
        for (std::size_t v = 0; v < mesh.weights.size(); ++v) {
            for (std::size_t i = 0; i < mesh.weights[v].size(); ++i) {
                weights[mesh.joints[v][i]] += mesh.weights[v][i];
                total += mesh.weights[v][i];
            }
        }
    }
    const auto most = std::max_element(weights.begin(), weights.end());
    if (total <= 0.0 || *most <= kMostOnOneJoint * total) return;
    const std::string& name = character.skeleton.names[static_cast<std::size_t>(most - weights.begin())];
    findings.push_back(
        error("skin-on-one-joint", name,
              fmt::format("{:.0f} % of the skin follows this joint, at most {:.0f} where there are {} bodies",
                          100.0 * *most / total, 100.0 * kMostOnOneJoint, plan.bodies.size()),
              "give the skin weights on the joints of the limbs, or map the joints that have them", {}));
}

Aabb boxOf(const PlannedBody& body) {
    Aabb box;
    for (const SkinPoint& point : body.skin)
        box.add(point.position);
    return box;
}

// A skin in another unit than its joints: a figure of centimetres on a skeleton of metres.
void findSmallSkin(const BodyPlan& plan, std::span<const PlacedShape> shapes, std::vector<Finding>& findings) {
    std::size_t skinned = 0;
    std::size_t small = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (plan.bodies[i].skin.empty()) continue;
        const Aabb box = boxOf(plan.bodies[i]);
        const vec3 half = halfExtents(shapes[i]);
        ++skinned;
        small += box.diagonal() < kSmallSkin * 2.0F * std::max({half.x, half.y, half.z}) ? 1 : 0;
    }
    if (skinned < kManyBodies || static_cast<float>(small) <= kMostSmall * static_cast<float>(skinned)) return;
    findings.push_back(error("skin-small", "/bodies",
                             fmt::format("the skin of {} of {} bodies is less than {:.0f} % of them long", small,
                                         skinned, 100.0F * kSmallSkin),
                             "give skin and skeleton the same unit; an armature's scale was applied to one of them",
                             {}));
}

float touchingShare(const PlannedBody& body, const PlacedShape& shape, float heightM) {
    const RigidTransform bodyFromStandard = inverse(shape.standardFromBody);
    float touching = 0.0F;
    for (const SkinPoint& point : body.skin) {
        const float distance = std::abs(signedDistance(shape.shape, bodyFromStandard * point.position));
        touching += distance <= kTouching * heightM ? point.area : 0.0F;
    }
    return touching / areaOf(body);
}

// A body that lies beside its skin: its middle is outside of all of it, and it hardly touches any. Examples are a
// capsule above the skull, or an arm's in the air. A leg whose skin is the ankle alone, below trousers, does touch
// that.
void findBodiesBesideSkin(const BodyPlan& plan, std::span<const PlacedShape> shapes, std::vector<Finding>& findings) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const PlannedBody& body = plan.bodies[i];
        const vec3 middle = shapes[i].standardFromBody.translation;
        const vec3 half = halfExtents(shapes[i]);
        const float surface = 8.0F * (half.x * half.y + half.y * half.z + half.z * half.x);
        if (areaOf(body) < kLeastSkin * surface) continue;
        const Aabb box = boxOf(body);
        const vec3 beyond = glm::max(box.low - middle, middle - box.high);
        const float distance = std::max({beyond.x, beyond.y, beyond.z});
        // The middle of a bear's neck may lie behind the collar of skin that follows it.
        const float within = kWithin * std::min({half.x, half.y, half.z});
        if (distance <= std::max(kBeside * plan.heightM, within)) continue;
        if (touchingShare(body, shapes[i], plan.heightM) > kMostTouching) continue;
        findings.push_back(error("body-beside-skin", body.name,
                                 fmt::format("its middle is {:.0f} % of the height beside its skin, at most {:.0f}",
                                             100.0F * distance / plan.heightM, 100.0F * kBeside),
                                 "fit the shape anew; if it stays there, the map or the skin's weights are wrong",
                                 {body.name}));
    }
}

// Whether no skin is at a point, and no body but the one asked about.
bool isInTheAir(const BodyPlan& plan, std::span<const PlacedShape> shapes, std::size_t body, const vec3& point,
                float atHand) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const vec3 inBody = inverse(shapes[i].standardFromBody) * point;
        if (i != body && signedDistance(shapes[i].shape, inBody) <= kTouching * plan.heightM) return false;
        for (const SkinPoint& skin : plan.bodies[i].skin)
            if (glm::distance(skin.position, point) <= atHand) return false;
    }
    return true;
}

}  // namespace

std::vector<Finding> findBodiesInTheAir(const BodyPlan& plan, std::span<const PlacedShape> shapes) {
    constexpr int kSamples = 5;
    std::vector<Finding> findings;
    const bool hasSkin =
        std::any_of(plan.bodies.begin(), plan.bodies.end(), [](const PlannedBody& body) { return !body.skin.empty(); });
    for (std::size_t i = 0; i < shapes.size() && hasSkin; ++i) {
        const vec3 half = halfExtents(shapes[i]);
        const float surface = 8.0F * (half.x * half.y + half.y * half.z + half.z * half.x);
        if (areaOf(plan.bodies[i]) >= kLeastSkin * surface) continue;
        const float thin = std::min({half.x, half.y, half.z});
        int inTheAir = 0;
        for (int k = 0; k < kSamples; ++k) {
            const float along = (half.y - thin) * (2.0F * static_cast<float>(k) / (kSamples - 1) - 1.0F);
            const vec3 point = shapes[i].standardFromBody * vec3(0, along, 0);
            inTheAir += isInTheAir(plan, shapes, i, point, thin + kTouching * plan.heightM) ? 1 : 0;
        }
        if (3 * inTheAir <= kSamples) continue;
        findings.push_back(
            {Severity::warning,
             "body-in-the-air",
             plan.bodies[i].name,
             fmt::format("{} of {} points along it are where there is no skin and no other body", inTheAir, kSamples),
             "leave its joint without a body, or give the skin weights on it",
             false,
             {plan.bodies[i].name}});
    }
    return findings;
}

std::vector<Finding> findBrokenFigure(const animation::Character& character, const BodyPlan& plan,
                                      std::span<const PlacedShape> shapes, const FitMeasures& fit) {
    std::vector<Finding> findings;
    findSkinElsewhere(plan, shapes, fit, findings);
    findSkinOnOneJoint(character, plan, findings);
    findBodiesInSkinOfOthers(plan, shapes, findings);
    findSmallSkin(plan, shapes, findings);
    findBodiesBesideSkin(plan, shapes, findings);
    return findings;
}

}  // namespace lutka::physics
