#include "physics/doctor/broken_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

constexpr float kLeastNear = 0.1F;       // of the skin's vertices near their body, below which …
constexpr float kLeastCovered = 0.12F;   // … with less than this of the volume in some body, the skin is elsewhere
constexpr float kFar = 0.06F;            // of the height: skin farther than that from all bodies hangs on none
constexpr float kMostFar = 0.5F;         // of the skin's area
constexpr double kMostOnOneJoint = 0.9;  // of the skin's weights, where there are …
constexpr std::size_t kManyBodies = 8;   // … so many bodies
constexpr float kBeside = 0.03F;         // of the height, beyond the box of a body's own skin
constexpr float kLeastSkin = 0.1F;       // of the shape's surface, below which its skin tells nothing
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

// Share of the skin's area that is far from every body.
float farShare(const BodyPlan& plan, std::span<const PlacedShape> shapes) {
    std::vector<RigidTransform> bodyFromStandard;
    for (const PlacedShape& shape : shapes)
        bodyFromStandard.push_back(inverse(shape.standardFromBody));
    float total = 0.0F;
    float far = 0.0F;
    for (const PlannedBody& body : plan.bodies) {
        for (const SkinPoint& point : body.skin) {
            total += point.area;
            bool near = false;
            for (std::size_t i = 0; i < shapes.size() && !near; ++i)
                near = signedDistance(shapes[i].shape, bodyFromStandard[i] * point.position) <= kFar * plan.heightM;
            far += near ? 0.0F : point.area;
        }
    }
    return total > 0.0F ? far / total : 0.0F;
}

void findSkinElsewhere(const BodyPlan& plan, std::span<const PlacedShape> shapes, const FitMeasures& fit,
                       std::vector<Finding>& findings) {
    constexpr const char* kMend =
        "look at the bodies on the skin: the map, the skin's weights or the bind pose are wrong";
    if (fit.vertices == 0) return;
    const float far = farShare(plan, shapes);
    if (far > kMostFar) {
        findings.push_back(error("skin-outside-bodies", "/bodies",
                                 fmt::format("{:.0f} % of the skin is more than {:.0f} % of the height from all bodies",
                                             100.0F * far, 100.0F * kFar),
                                 kMend, {}));
    } else if (fit.volumeCovered && fit.skinNear < kLeastNear && *fit.volumeCovered < kLeastCovered) {
        findings.push_back(error("skin-outside-bodies", "/bodies",
                                 fmt::format("{:.0f} % of the skin is near its body and {:.0f} % of the volume in one",
                                             100.0F * fit.skinNear, 100.0F * *fit.volumeCovered),
                                 kMend, {}));
    }
}

// By the weights: the fit itself parts the skin of a trunk among its bodies by height.
void findSkinOnOneJoint(const animation::Character& character, const BodyPlan& plan, std::vector<Finding>& findings) {
    if (plan.bodies.size() < kManyBodies) return;
    std::vector<double> weights(character.skeleton.names.size(), 0.0);
    double total = 0.0;
    for (const animation::SkinnedMesh& mesh : character.meshes) {
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

float touchingShare(const PlannedBody& body, const PlacedShape& shape, float heightM) {
    const RigidTransform bodyFromStandard = inverse(shape.standardFromBody);
    float touching = 0.0F;
    for (const SkinPoint& point : body.skin) {
        const float distance = std::abs(signedDistance(shape.shape, bodyFromStandard * point.position));
        touching += distance <= kTouching * heightM ? point.area : 0.0F;
    }
    return touching / areaOf(body);
}

// A body whose middle lies beside all the skin that follows it, and that hardly touches any of it: a capsule above the
// skull, an arm's in the air. A leg of which clothes hide all but the ankle touches that.
void findBodiesBesideSkin(const BodyPlan& plan, std::span<const PlacedShape> shapes, std::vector<Finding>& findings) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const PlannedBody& body = plan.bodies[i];
        const vec3 middle = shapes[i].standardFromBody.translation;
        const vec3 half(halfWidth(shapes[i].shape, {1, 0, 0}), halfWidth(shapes[i].shape, {0, 1, 0}),
                        halfWidth(shapes[i].shape, {0, 0, 1}));
        const float surface = 8.0F * (half.x * half.y + half.y * half.z + half.z * half.x);
        if (areaOf(body) < kLeastSkin * surface) continue;
        vec3 low(1e9F);
        vec3 high(-1e9F);
        for (const SkinPoint& point : body.skin) {
            low = glm::min(low, point.position);
            high = glm::max(high, point.position);
        }
        const vec3 beyond = glm::max(low - middle, middle - high);
        const float distance = std::max({beyond.x, beyond.y, beyond.z});
        if (distance <= kBeside * plan.heightM) continue;
        if (touchingShare(body, shapes[i], plan.heightM) > kMostTouching) continue;
        findings.push_back(error("body-beside-skin", body.name,
                                 fmt::format("its middle is {:.0f} % of the height beside its skin, at most {:.0f}",
                                             100.0F * distance / plan.heightM, 100.0F * kBeside),
                                 "fit the shape anew; if it stays there, the map or the skin's weights are wrong",
                                 {body.name}));
    }
}

}  // namespace

std::vector<Finding> findBrokenFigure(const animation::Character& character, const BodyPlan& plan,
                                      std::span<const PlacedShape> shapes, const FitMeasures& fit) {
    std::vector<Finding> findings;
    findSkinElsewhere(plan, shapes, fit, findings);
    findSkinOnOneJoint(character, plan, findings);
    findBodiesBesideSkin(plan, shapes, findings);
    return findings;
}

}  // namespace lutka::physics
