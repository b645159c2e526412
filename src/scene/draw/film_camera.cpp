#include "scene/draw/film_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/aabb.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "scene/draw/scene_extent.hpp"

namespace lutka::scene {
namespace {

constexpr float kShareOfHeight = 0.48F;   // of the picture, that a standing figure takes
constexpr float kTimeConstant = 0.3F;     // seconds: of the way to where the dolls are
constexpr float kLargestLag = 0.14F;      // of the picture's height, that they are ahead at most
constexpr float kRoomAround = 0.12F;      // of the picture, on each side of a group
constexpr float kLeastRoom = 0.02F;       // of the picture, that a group keeps however fast it goes apart
constexpr float kRoomAroundOne = 0.25F;   // on each side of a single doll, which moves faster than the camera
constexpr float kRoomAroundSkin = 0.04F;  // and at least so much of it beside capes, wings and what it carries
constexpr float kNearest = 0.6F;          // of the distance for a standing figure, to one that lies
constexpr float kApproachTime = 1.0F;     // seconds: slow, so that a doll that bounces doesn't pump the picture

float tallest(const Simulation& simulation) {
    float height = 0.0F;
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        height = std::max(height, simulation.assetOf(doll).profile.heightM);
    return height;
}

// The part of the way to a goal that is gone in a time.
float shareIn(float seconds, float timeConstant = kTimeConstant) {
    return 1.0F - std::exp(-seconds / timeConstant);
}

// With the least room at each edge.
bool showsAll(const render::Camera& camera, std::span<const vec3> points, float aspect) {
    const mat4 clipFromWorld = render::clipFromWorld(camera, aspect);
    return std::ranges::all_of(points, [&](const vec3& point) {
        const vec4 clip = clipFromWorld * vec4(point, 1);
        return std::max(std::abs(clip.x), std::abs(clip.y)) <= (1.0F - 2.0F * kLeastRoom) * clip.w;
    });
}

// Of a ball that holds bodies and skin however limbs turn: by body, how far the skin that is nearest to it reaches from
// it, horns, wings and hats as well as hands.
float radiusAround(const vec3& centre, std::span<const RigidTransform> worldFromBody, const RagdollAsset& asset) {
    const std::vector<RigidTransform>& bind = asset.rig.bindModelFromBody;
    std::vector<float> reach(bind.size(), 0.0F);
    for (const animation::SkinnedMesh& mesh : asset.character.meshes) {
        for (const vec3& position : mesh.positions) {
            const auto away = [&](const RigidTransform& body) { return glm::distance(position, body.translation); };
            const auto nearest = std::ranges::min_element(bind, {}, away);
            float& most = reach[static_cast<std::size_t>(nearest - bind.begin())];
            most = std::max(most, away(*nearest));
        }
    }
    float radius = 0.0F;
    for (std::size_t body = 0; body < reach.size(); ++body)
        radius = std::max(radius, glm::distance(centre, worldFromBody[body].translation) + reach[body]);
    return radius;
}

}  // namespace

FilmCamera::FilmCamera(const Scenario& scenario, float aspect)
    : camera(cameraFor(scenario, aspect)), aspect_(aspect), following_(!scenario.camera && scenario.focusFollows) {}

void FilmCamera::followDoll(int doll) {
    following_ = true;
    alone_ = doll;
}

void FilmCamera::keepDistance(float distance) {
    camera.distance = distance;
    keepsDistance_ = true;
}

void FilmCamera::update(Simulation& simulation, float alpha, float seconds) {
    if (alone_ && *alone_ < simulation.dollCount()) return followAlone(simulation, alpha, seconds);
    if (following_ && simulation.dollCount() > 0) follow(simulation, alpha, seconds);
}

void FilmCamera::followAlone(Simulation& simulation, float alpha, float seconds) {
    const auto bodies = simulation.worldFromBody(*alone_, alpha);
    Aabb box;
    for (const RigidTransform& body : bodies)
        box.add(body.translation);
    const vec3 centre = box.middle();
    if (begun_) {
        camera.target += (centre - camera.target) * shareIn(std::max(seconds, 0.0F));
        return;
    }
    begun_ = true;
    constexpr float outline = 1.25F;  // bodies' centres end short of the figure's own
    const float radius =
        std::max(box.diagonal() * 0.5F * outline, radiusAround(centre, bodies, simulation.assetOf(*alone_)));
    const float distance = camera.distance;
    render::frameSphere(camera, centre, radius, aspect_);
    if (keepsDistance_) camera.distance = distance;
}

void FilmCamera::follow(Simulation& simulation, float alpha, float seconds) {
    points_.clear();
    for (int doll = 0; doll < simulation.dollCount(); ++doll)
        addExtentOfDoll(simulation, doll, alpha, points_);
    Aabb box;
    for (const vec3& point : points_)
        box.add(point);
    const bool single = simulation.dollCount() == 1;
    const float room = single ? kRoomAroundOne : kRoomAround;
    render::Camera group = camera;
    render::framePoints(group, points_, aspect_, {room, room, room, room});
    // The group's distance is one from the group's target: about another point those in front would be cut off.
    const vec3 centre = single ? box.middle() : group.target;
    const float slope = 2.0F * std::tan(0.5F * camera.fieldOfView);
    // In a narrow picture the figure lies across its width in the end.
    const float alone = tallest(simulation) / (kShareOfHeight * slope * std::min(1.0F, aspect_));
    render::Camera whole = camera;
    render::framePoints(whole, points_, aspect_, {kRoomAroundSkin, kRoomAroundSkin, kRoomAroundSkin, kRoomAroundSkin});
    // Framed about the group's target, and seen about the middle of its box.
    const float least = whole.distance + (single ? glm::distance(centre, whole.target) : 0.0F);
    const float distance =
        single ? std::max(std::clamp(group.distance, kNearest * alone, alone), least) : std::max(alone, group.distance);
    if (!begun_) {
        begun_ = true;
        camera.target = centre;
        if (!keepsDistance_) camera.distance = single ? std::max(alone, least) : distance;
        return;
    }
    const float passed = std::max(seconds, 0.0F);
    camera.target += (centre - camera.target) * shareIn(passed);
    const float distanceTime = single && distance < camera.distance ? kApproachTime : kTimeConstant;
    if (!keepsDistance_) camera.distance += (distance - camera.distance) * shareIn(passed, distanceTime);
    const vec3 lag = camera.target - centre;
    const float most = kLargestLag * slope * camera.distance;
    if (glm::length(lag) > most) camera.target = centre + glm::normalize(lag) * most;
    if (!single && !keepsDistance_) keepAllIn(points_, centre, distance);
}

void FilmCamera::keepAllIn(std::span<const vec3> points, const vec3& target, float distance) {
    const auto towards = [&](float share) {
        render::Camera nearer = camera;
        nearer.target = glm::mix(camera.target, target, share);
        nearer.distance = glm::mix(camera.distance, distance, share);
        return nearer;
    };
    if (showsAll(camera, points, aspect_)) return;
    float least = 0.0F;
    float enough = 1.0F;
    constexpr int halvings = 8;  // to less than a pixel of a film
    for (int i = 0; i < halvings; ++i) {
        const float middle = 0.5F * (least + enough);
        (showsAll(towards(middle), points, aspect_) ? enough : least) = middle;
    }
    camera = towards(enough);
}

}  // namespace lutka::scene
