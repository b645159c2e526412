#include "scene/draw/draw_simulation.hpp"

#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/camera.hpp"
#include "scene/draw/draw_debug.hpp"

namespace lutka::scene {
namespace {

using physics::StaticShape;
using render::Color;

const Look kGeometryLook;
const Look kPropLook{Color{206, 120, 70, 255}};
constexpr float kContactNormalLength = 0.08F;
constexpr float kSleepTint = 0.6F;
constexpr float kHiddenLineOpacity = 0.35F;
constexpr float kInnerLineOpacity = 0.8F;

// A plane that faces up is drawn as the renderer's floor, every other piece of geometry as a prop.
bool isFloor(const StaticShape& shape) {
    return shape.kind == StaticShape::Kind::plane && (shape.worldFromShape.rotation * vec3(0, 1, 0)).y > 0.999F;
}

void drawMesh(const StaticShape& shape, Color color, render::LineBatch& lines) {
    const auto vertices = shape.mesh->vertices();
    for (const physics::TriangleMesh::Edge& edge : shape.mesh->edges())
        lines.add(shape.worldFromShape * vertices[edge.start], shape.worldFromShape * vertices[edge.end], color);
}

Look lookAt(const std::vector<Look>& looks, std::size_t index, const Look& otherwise) {
    return index < looks.size() ? looks[index] : otherwise;
}

void drawStatics(const Scenario& scenario, render::FrameDescription& frame) {
    frame.floor.visible = false;
    for (std::size_t i = 0; i < scenario.statics.size(); ++i) {
        const StaticShape& shape = scenario.statics[i];
        const Look look = lookAt(scenario.staticLooks, i, kGeometryLook);
        if (!look.visible) continue;
        if (isFloor(shape)) {
            frame.floor.visible = true;
            frame.floor.height = shape.worldFromShape.translation.y;
            if (i < scenario.staticLooks.size()) frame.floor.color = look.color;
            continue;
        }
        if (shape.kind == StaticShape::Kind::mesh) {
            drawMesh(shape, look.color, frame.lines);
            continue;
        }
        render::PropItem& item = frame.props.emplace_back();
        item.kind = shape.kind;
        item.radius = shape.radius;
        item.halfLength = shape.halfLength;
        item.worldFromShape = shape.worldFromShape;
        item.halfExtents = shape.kind == StaticShape::Kind::plane ? vec3(20.0F) : shape.halfExtents;
        item.color = look.color;
        item.castsShadow = look.castsShadow;
        item.checkerSize = 0.5F;
        item.checkerInWorld = true;
    }
}

void drawLights(const Scenario& scenario, render::FrameDescription& frame) {
    if (scenario.sun) frame.sun = *scenario.sun;
    frame.localLights.insert(frame.localLights.end(), scenario.lights.begin(), scenario.lights.end());
}

void drawProps(const Simulation& simulation, float alpha, render::FrameDescription& frame) {
    const auto& props = simulation.scenario().props;
    for (std::size_t i = 0; i < props.size(); ++i) {
        const physics::BodyShape& shape = props[i].shape;
        const Look look = lookAt(simulation.scenario().propLooks, i, kPropLook);
        if (!look.visible || !simulation.showsProp(static_cast<int>(i))) continue;
        render::PropItem& item = frame.props.emplace_back();
        item.kind = shapeKindOf(shape.kind);
        item.worldFromShape = simulation.worldFromProp(static_cast<int>(i), alpha);
        item.halfExtents = shape.halfExtents;
        item.radius = shape.radius;
        item.halfLength = shape.halfLength;
        item.color = look.color;
        item.castsShadow = look.castsShadow;
        item.checkerSize = 0.08F;
    }
}

Color sleepColor(bool asleep) {
    return asleep ? debugColors::asleep : debugColors::awake;
}

void drawBulletLayer(Simulation& simulation, render::FrameDescription& frame) {
    simulation.world().drawDebug([&](const vec3& from, const vec3& to, const vec3& color) {
        const vec3 bytes = glm::clamp(color, 0.0F, 1.0F) * 255.0F;
        frame.lines.add(from, to,
                        {static_cast<std::uint8_t>(bytes.x), static_cast<std::uint8_t>(bytes.y),
                         static_cast<std::uint8_t>(bytes.z), 255});
    });
}

bool anyDollLayer(const DebugLayers& layers) {
    return layers.capsules || layers.solidCapsules || layers.skeleton || layers.joints || layers.limits ||
           layers.velocities || layers.centresOfMass || layers.aabbs;
}

}  // namespace

void SimulationDrawer::draw(Simulation& simulation, std::span<const render::CharacterHandle> characters,
                            const DebugLayers& layers, float alpha, float opacity, render::FrameDescription& frame) {
    itemOfDoll_.assign(static_cast<std::size_t>(simulation.dollCount()), -1);
    const auto start = std::chrono::steady_clock::now();
    const PosedSkins& skins = simulation.poseSkins(alpha);
    poseMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    posedDolls_ = skins.posed();
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        if (!simulation.showsDoll(doll)) continue;
        const RagdollAsset& asset = simulation.assetOf(doll);
        const Placement& placement = simulation.scenario().dolls[doll];
        const render::CharacterHandle character = characters[static_cast<std::size_t>(placement.asset)];
        if (opacity > 0.0F && character.valid() && placement.look.visible) {
            const vec4 tint = toLinear(placement.look.color);
            itemOfDoll_[doll] = static_cast<int>(frame.characters.size());
            render::CharacterItem& item = frame.characters.emplace_back();
            item.character = character;
            item.palette = skins.palette(doll);
            item.worldFromModel = simulation.worldFromModel(doll);
            item.tint = vec3(tint);
            item.opacity = opacity * tint.a;
            item.castsShadow = placement.look.castsShadow;
            item.skinning = skinning;
            if (layers.sleep) item.highlight = withAlpha(sleepColor(simulation.isAsleep(doll)), kSleepTint);
        }
        if (anyDollLayer(layers)) {
            states_.resize(asset.profile.bodies.size());
            simulation.getBodies(doll, states_);
            drawDollDebug({asset, simulation.worldFromBody(doll, alpha), states_, skins.modelFromJoint(doll),
                           simulation.worldFromModel(doll), simulation.isAsleep(doll)},
                          layers, scratch_, frame);
        }
    }
    // Bones lie inside the skin: there what is hidden is the very thing to see.
    const bool inside = layers.skeleton || layers.joints;
    frame.hiddenLineOpacity = inside ? kInnerLineOpacity : kHiddenLineOpacity;
    drawStatics(simulation.scenario(), frame);
    drawLights(simulation.scenario(), frame);
    drawProps(simulation, alpha, frame);
    if (layers.contacts) drawContacts(simulation, frame);
    if (layers.bullet) drawBulletLayer(simulation, frame);
}

void SimulationDrawer::drawContacts(Simulation& simulation, render::FrameDescription& frame) {
    contacts_.clear();
    simulation.world().getContacts(contacts_);
    for (const physics::ContactPoint& contact : contacts_) {
        const Color color = contact.distance < 0.0F ? debugColors::penetrating : debugColors::touching;
        // Either body may be the second; the side that faces up is the one that is seen.
        const vec3 normal = contact.normal.y < 0.0F ? -contact.normal : contact.normal;
        addCross(frame.lines, contact.position, 0.03F, color);
        addArrow(frame.lines, contact.position, contact.position + normal * kContactNormalLength, color);
    }
}

render::Camera cameraFor(const Scenario& scenario, float aspect) {
    if (scenario.camera) return *scenario.camera;
    render::Camera camera;
    camera.yaw = scenario.focusYaw;
    camera.pitch = scenario.focusPitch;
    render::frameSphere(camera, scenario.focus, scenario.focusRadius, aspect, 1.0F);
    return camera;
}

}  // namespace lutka::scene
