#include "editor/view/describe_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/draw/draw_hull.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kSelection{255, 150, 46, 110};
constexpr render::Color kSelectionLine{255, 150, 46, 255};
constexpr render::Color kPin{90, 200, 255, 255};
constexpr render::Color kMarker{214, 218, 224, 255};
constexpr float kMarkerSize = 0.12F;  // metres

void drawArrowAlong(const RigidTransform& frame, float length, render::Color color, render::LineBatch& lines) {
    addArrow(lines, frame.translation, frame * vec3(0, 0, -length), color);
}

void drawLight(const scene::Light& light, const RigidTransform& frame, bool selected, render::LineBatch& lines) {
    const render::Color color = selected ? kSelectionLine : render::fromLinear(vec4(light.color, 1.0F));
    render::addSphere(lines, frame.translation, kMarkerSize * 0.5F, color);
    render::addCross(lines, frame.translation, kMarkerSize * 2.0F, color);
    if (light.kind != scene::Light::Kind::point) drawArrowAlong(frame, 0.5F, color, lines);
    if (light.kind != scene::Light::Kind::spot || !selected) return;
    // The rim of the cone a metre away.
    constexpr int sides = 24;
    const float radius = std::min(std::tan(light.outerAngle), 3.0F);
    const auto rim = [&](int side) {
        const float angle = 2.0F * kPi * static_cast<float>(side) / static_cast<float>(sides);
        return frame * vec3(radius * std::cos(angle), radius * std::sin(angle), -1.0F);
    };
    for (int side = 0; side < sides; ++side) {
        lines.add(rim(side), rim(side + 1), color);
        if (side % 6 == 0) lines.add(frame.translation, rim(side), color);
    }
}

// The pyramid that it looks through.
void drawCamera(const scene::Camera& camera, const RigidTransform& frame, bool selected, render::LineBatch& lines) {
    const render::Color color = selected ? kSelectionLine : kMarker;
    constexpr float depth = 0.3F;
    constexpr float aspect = 1.6F;
    const float height = depth * std::tan(std::min(camera.fieldOfView, 2.6F) * 0.5F);
    const auto corner = [&](int index) {
        const float x = index == 0 || index == 3 ? -1.0F : 1.0F;
        const float y = index < 2 ? -1.0F : 1.0F;
        return frame * vec3(x * height * aspect, y * height, -depth);
    };
    for (int index = 0; index < 4; ++index) {
        lines.add(frame.translation, corner(index), color);
        lines.add(corner(index), corner((index + 1) % 4), color);
    }
    lines.add(corner(3), frame * vec3(0, height * 1.5F, -depth), color);
    lines.add(corner(2), frame * vec3(0, height * 1.5F, -depth), color);
}

void drawShape(const scene::Collider& collider, const RigidTransform& frame, render::LineBatch& lines) {
    using Kind = scene::Collider::Kind;
    if (collider.kind == Kind::sphere) {
        render::addSphere(lines, frame.translation, collider.radius * 1.02F, kSelectionLine);
    } else if (collider.kind == Kind::capsule) {
        render::addCapsule(lines, frame, collider.radius * 1.02F, collider.halfLength, kSelectionLine);
    } else if (collider.kind == Kind::box) {
        render::addBox(lines, frame, collider.halfExtents, kSelectionLine);
    }
    for (const scene::ColliderBox& box : scene::boxesOf(collider))
        render::addBox(lines, frame * box.entityFromBox, box.halfExtents, kSelectionLine);
}

void highlight(const Workspace& workspace, const scene::SimulationDrawer& drawer, render::FrameDescription& frame) {
    const Player& player = *workspace.player;
    for (const Item& item : workspace.selection.items()) {
        const bool body = item.kind == Item::Kind::body;
        const int doll = body ? item.doll : player.dollOf(static_cast<scene::EntityId>(item.index));
        const int at = doll >= 0 ? drawer.characterItem(doll) : -1;
        if (at < 0) continue;
        frame.characters[at].highlight = kSelection;
        frame.characters[at].highlightJoint = body ? workspace.document->asset().rig.jointOfBody[item.index] : -1;
    }
}

void drawLightsAndCameras(const Workspace& workspace, render::LineBatch& lines) {
    const scene::EntityScene& scene = workspace.document->scene();
    const Player& player = *workspace.player;
    const auto selected = [&](scene::EntityId id) {
        return workspace.selection.contains({Item::Kind::object, 0, static_cast<int>(id)});
    };
    for (const scene::Light& light : scene.all<scene::Light>())
        drawLight(light, player.worldFromEntity(light.entity), selected(light.entity), lines);
    for (const scene::Camera& camera : scene.all<scene::Camera>()) {
        const RigidTransform place = player.worldFromEntity(camera.entity);
        constexpr float here = 0.1F;  // metres: who looks through a camera does not see it
        if (glm::distance(place.translation, render::eyeOf(workspace.camera)) < here) continue;
        drawCamera(camera, place, selected(camera.entity), lines);
    }
}

void drawPrimitive(const physics::PrimitiveShape& shape, const RigidTransform& worldFromShape, render::Color color,
                   render::LineBatch& lines) {
    if (shape.kind == physics::PrimitiveShape::Kind::capsule) {
        render::addCapsule(lines, worldFromShape, shape.radius, shape.halfLength, color);
    } else if (shape.kind == physics::PrimitiveShape::Kind::sphere) {
        render::addSphere(lines, worldFromShape.translation, shape.radius, color);
    } else if (shape.kind == physics::PrimitiveShape::Kind::hull) {
        scene::addHull(lines, worldFromShape, *shape.hull, color);
    } else {
        render::addBox(lines, worldFromShape, shape.halfExtents, color);
    }
}

void drawBody(const physics::BodyShape& body, const RigidTransform& worldFromBody, render::Color color,
              render::LineBatch& lines) {
    visitShapes(body, [&](const physics::PrimitiveShape& shape, const RigidTransform& bodyFromShape) {
        drawPrimitive(shape, worldFromBody * bodyFromShape, color, lines);
    });
}

constexpr render::Color kOnTarget{38, 217, 38, 255};
constexpr render::Color kOffTarget{255, 64, 38, 255};
// Not red, which is what is wrong.
constexpr render::Color kNoStrength{72, 84, 120, 255};
constexpr render::Color kFullStrength{255, 214, 64, 255};

render::Color between(const render::Color& none, const render::Color& full, float share, unsigned char opacity) {
    const auto mixed = [&](unsigned char a, unsigned char b) {
        return static_cast<unsigned char>(std::lround(glm::mix(static_cast<float>(a), static_cast<float>(b), share)));
    };
    return {mixed(none.r, full.r), mixed(none.g, full.g), mixed(none.b, full.b), opacity};
}

bool isThere(const RigidTransform& body, const RigidTransform& pose) {
    constexpr float kNearM = 0.015F;
    constexpr float kNear = radians(3.0F);
    const quat off = glm::normalize(body.rotation * glm::conjugate(pose.rotation));
    return glm::distance(body.translation, pose.translation) < kNearM && glm::length(rotationVector(off)) < kNear;
}

// The pose that a puppet follows, each body by how far its joint is from it. Where the bodies themselves are coloured
// (`overBodies`) those that are in it are left out: two colours on one line are none.
void drawGhost(scene::Simulation& simulation, int doll, std::span<const RigidTransform> bodies, float alpha,
               bool overBodies, render::LineBatch& lines) {
    constexpr float most = radians(30.0F);  // and more: red
    constexpr unsigned char opacity = 150;
    const physics::RagdollProfile& profile = simulation.assetOf(doll).profile;
    const std::span<const RigidTransform> pose = simulation.puppets()->pose(doll, alpha);
    std::vector<float> errors(profile.constraints.size());
    physics::jointErrors(profile, pose, bodies, errors);
    for (std::size_t body = 0; body < pose.size(); ++body) {
        if (overBodies && isThere(bodies[body], pose[body])) continue;
        const float error = body > 0 ? errors[body - 1] : 0.0F;
        drawBody(profile.bodies[body].shape, pose[body],
                 between(kOnTarget, kOffTarget, std::min(error / most, 1.0F), opacity), lines);
    }
}

// Each body's shape in the colour of the strength that its joint has now.
void drawStrength(scene::Simulation& simulation, int doll, std::span<const RigidTransform> bodies,
                  render::LineBatch& lines) {
    const physics::RagdollProfile& profile = simulation.assetOf(doll).profile;
    physics::Puppet& puppet = simulation.puppets()->puppet(doll);
    for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
        const float own = physics::strengthOf(puppet.settings().muscles, profile, body);
        const float share = std::min(own * puppet.strengthLeft(body), 1.0F);
        drawBody(profile.bodies[body].shape, bodies[body], between(kNoStrength, kFullStrength, share, 255), lines);
    }
}

void drawPuppets(const Workspace& workspace, const ViewSettings& view, render::LineBatch& lines) {
    scene::Simulation& simulation = workspace.player->simulation();
    if (simulation.puppets() == nullptr) return;
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const float alpha = workspace.player->alpha();
        const auto bodies = simulation.worldFromBody(doll, alpha);
        const bool limp = simulation.puppets()->puppet(doll).state() == physics::PuppetState::limp;
        if (view.ghost && !limp) drawGhost(simulation, doll, bodies, alpha, view.strength, lines);
        if (view.strength) drawStrength(simulation, doll, bodies, lines);
    }
}

// Objects before bodies, so that what is selected of a doll lies over what it stands on.
void drawSelection(const Workspace& workspace, render::LineBatch& lines) {
    Player& player = *workspace.player;
    for (const Item& item : workspace.selection.items()) {
        if (item.kind != Item::Kind::object) continue;
        const auto id = static_cast<scene::EntityId>(item.index);
        if (const auto* collider = workspace.document->scene().find<scene::Collider>(id)) {
            drawShape(*collider, player.worldFromEntity(id), lines);
        }
    }
    for (const Item& item : workspace.selection.items()) {
        if (item.kind != Item::Kind::body) continue;
        drawBody(workspace.document->profile().bodies[item.index].shape,
                 player.simulation().worldFromBody(item.doll, player.alpha())[item.index], kSelectionLine, lines);
    }
}

void drawActivePart(const Workspace& workspace, render::LineBatch& lines) {
    if (!workspace.showHandles) return;
    const auto scene = workspace.handleScene();
    if (!scene) return;
    const std::vector<Handle> handles = handlesOf(*scene, workspace.camera);
    drawHandles(*scene, handles, workspace.hotHandle, workspace.camera, lines);
}

void drawPins(const Workspace& workspace, render::LineBatch& lines) {
    for (const Pull& pin : workspace.pulls.pins) {
        render::addSphere(lines, pin.target, 0.025F, kPin);
        render::addCross(lines, pin.target, 0.1F, kPin);
    }
}

}  // namespace

std::array<render::LegendEntry, 2> targetLegend() {
    return {{{kOnTarget, "in the pose"}, {kOffTarget, "a joint 30 degrees off"}}};
}

std::array<render::LegendEntry, 2> strengthLegend() {
    return {{{kFullStrength, "all of its strength"}, {kNoStrength, "none"}}};
}

void describeFrame(const Workspace& workspace, const ViewSettings& view, scene::SimulationDrawer& drawer,
                   std::span<const render::CharacterHandle> characters, render::FrameDescription& frame) {
    frame.clear();
    frame.camera = workspace.camera;
    drawer.skinning =
        view.dualQuaternions ? animation::SkinningMethod::dualQuaternion : animation::SkinningMethod::linear;
    drawer.draw(workspace.player->simulation(), characters, view.debug ? view.layers : scene::DebugLayers{},
                workspace.player->alpha(), view.skinOpacity, frame);
    highlight(workspace, drawer, frame);
    drawLightsAndCameras(workspace, frame.lines);
    drawPuppets(workspace, view, frame.lines);
    drawSelection(workspace, frame.lines);
    drawActivePart(workspace, frame.lines);
    drawPins(workspace, frame.lines);
    const auto& lines = workspace.overlay.vertices;
    frame.lines.vertices.insert(frame.lines.vertices.end(), lines.begin(), lines.end());
}

}  // namespace lutka::editor
