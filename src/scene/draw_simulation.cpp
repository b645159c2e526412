#include "scene/draw_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "animation/skinning.hpp"
#include "render/camera.hpp"
#include "scene/draw_debug.hpp"

namespace lutka::scene {
namespace {

using physics::StaticShape;
using render::Color;

constexpr Color kGeometryColor{172, 177, 184, 255};
constexpr Color kPropColor{206, 120, 70, 255};
constexpr float kContactNormalLength = 0.08F;

struct LayerName {
    std::string_view name;
    bool DebugLayers::*layer;
};

constexpr std::array<LayerName, 8> kLayerNames{{
    {"capsules", &DebugLayers::capsules},
    {"solids", &DebugLayers::solidCapsules},
    {"joints", &DebugLayers::joints},
    {"limits", &DebugLayers::limits},
    {"contacts", &DebugLayers::contacts},
    {"velocities", &DebugLayers::velocities},
    {"com", &DebugLayers::centresOfMass},
    {"aabbs", &DebugLayers::aabbs},
}};

// A plane that faces up is drawn as the renderer's floor, every other piece of geometry as a prop.
bool isFloor(const StaticShape& shape) {
    return shape.kind == StaticShape::Kind::plane && (shape.worldFromShape.rotation * vec3(0, 1, 0)).y > 0.999F;
}

render::PropItem::Kind itemKindOf(StaticShape::Kind kind) {
    switch (kind) {
        case StaticShape::Kind::plane:
            return render::PropItem::Kind::plane;
        case StaticShape::Kind::sphere:
            return render::PropItem::Kind::sphere;
        case StaticShape::Kind::capsule:
            return render::PropItem::Kind::capsule;
        case StaticShape::Kind::box:
        case StaticShape::Kind::mesh:
            break;
    }
    return render::PropItem::Kind::box;
}

void drawMesh(const StaticShape& shape, render::LineBatch& lines) {
    const auto vertices = shape.mesh->vertices();
    for (const physics::TriangleMesh::Edge& edge : shape.mesh->edges())
        lines.add(shape.worldFromShape * vertices[edge.start], shape.worldFromShape * vertices[edge.end],
                  kGeometryColor);
}

void drawStatics(const Scenario& scenario, render::FrameDescription& frame) {
    frame.floor.visible = false;
    for (const StaticShape& shape : scenario.statics) {
        if (isFloor(shape)) {
            frame.floor.visible = true;
            frame.floor.height = shape.worldFromShape.translation.y;
            continue;
        }
        if (shape.kind == StaticShape::Kind::mesh) {
            drawMesh(shape, frame.lines);
            continue;
        }
        render::PropItem& item = frame.props.emplace_back();
        item.kind = itemKindOf(shape.kind);
        item.radius = shape.radius;
        item.halfLength = shape.halfLength;
        item.worldFromShape = shape.worldFromShape;
        item.halfExtents = shape.kind == StaticShape::Kind::plane ? vec3(20.0F) : shape.halfExtents;
        item.color = kGeometryColor;
        item.checkerSize = 0.5F;
        item.checkerInWorld = true;
    }
}

// The pit's walls would hide what falls into it.
void makeWallsOfPileSeeThrough(const Scenario& scenario, render::FrameDescription& frame) {
    if (scenario.name != "pile") return;
    for (render::PropItem& item : frame.props) {
        item.color.a = 40;
        item.castsShadow = false;
    }
}

void drawProps(const Simulation& simulation, float alpha, render::FrameDescription& frame) {
    const auto& props = simulation.scenario().props;
    for (std::size_t i = 0; i < props.size(); ++i) {
        const physics::BodyShape& shape = props[i].shape;
        render::PropItem& item = frame.props.emplace_back();
        switch (shape.kind) {
            case physics::BodyShape::Kind::sphere:
                item.kind = render::PropItem::Kind::sphere;
                break;
            case physics::BodyShape::Kind::box:
                item.kind = render::PropItem::Kind::box;
                break;
            case physics::BodyShape::Kind::capsule:
                item.kind = render::PropItem::Kind::capsule;
                break;
        }
        item.worldFromShape = simulation.worldFromProp(static_cast<int>(i), alpha);
        item.halfExtents = shape.halfExtents;
        item.radius = shape.radius;
        item.halfLength = shape.halfLength;
        item.color = kPropColor;
        item.checkerSize = 0.08F;
    }
}

bool anyDollLayer(const DebugLayers& layers) {
    return layers.capsules || layers.solidCapsules || layers.joints || layers.limits || layers.velocities ||
           layers.centresOfMass || layers.aabbs;
}

}  // namespace

Result<DebugLayers> parseDebugLayers(std::string_view list) {
    DebugLayers layers;
    while (!list.empty()) {
        const std::string_view word = list.substr(0, list.find(','));
        list.remove_prefix(std::min(word.size() + 1, list.size()));
        const auto* known = std::find_if(kLayerNames.begin(), kLayerNames.end(),
                                         [&](const LayerName& layer) { return layer.name == word; });
        if (known == kLayerNames.end()) {
            std::string names;
            for (const LayerName& layer : kLayerNames)
                names += fmt::format("{}{}", names.empty() ? "" : ", ", layer.name);
            return Error{ErrorCode::usage, fmt::format("there is no debug layer named '{}'", word), "--debug",
                         "the layers are " + names};
        }
        layers.*(known->layer) = true;
    }
    return layers;
}

void SimulationDrawer::draw(Simulation& simulation, render::CharacterHandle character, const DebugLayers& layers,
                            float alpha, float opacity, render::FrameDescription& frame) {
    const RagdollAsset& asset = simulation.asset();
    const animation::Skeleton& skeleton = asset.character.skeleton;
    joints_ = skeleton.parents.size();
    const auto dolls = static_cast<std::size_t>(simulation.dollCount());
    poses_.resize(joints_ * dolls);
    palettes_.resize(joints_ * dolls);
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const std::size_t first = joints_ * static_cast<std::size_t>(doll);
        const std::span pose = std::span(poses_).subspan(first, joints_);
        const std::span palette = std::span(palettes_).subspan(first, joints_);
        simulation.pose(doll, alpha, pose);
        animation::skinMatrices(skeleton.bindModelFromJoint, pose, palette);
        if (opacity > 0.0F && character.valid()) {
            render::CharacterItem& item = frame.characters.emplace_back();
            item.character = character;
            item.palette = palette;
            item.worldFromModel = simulation.worldFromModel(doll);
            item.opacity = opacity;
            item.skinning = skinning;
        }
        if (anyDollLayer(layers)) {
            states_.resize(asset.profile.bodies.size());
            simulation.world().getBodies(doll, states_);
            drawDollDebug({asset, simulation.worldFromBody(doll, alpha), states_, pose, simulation.worldFromModel(doll),
                           simulation.world().isAsleep(doll)},
                          layers, frame);
        }
    }
    drawStatics(simulation.scenario(), frame);
    makeWallsOfPileSeeThrough(simulation.scenario(), frame);
    drawProps(simulation, alpha, frame);
    if (layers.contacts) {
        contacts_.clear();
        simulation.world().getContacts(contacts_);
        for (const physics::ContactPoint& contact : contacts_) {
            const Color color = contact.distance < 0.0F ? render::colors::red : render::colors::yellow;
            addCross(frame.lines, contact.position, 0.03F, color);
            addArrow(frame.lines, contact.position, contact.position + contact.normal * kContactNormalLength, color);
        }
    }
}

std::span<const RigidTransform> SimulationDrawer::modelFromJoint(int doll) const {
    return std::span(poses_).subspan(joints_ * static_cast<std::size_t>(doll), joints_);
}

render::Camera cameraFor(const Scenario& scenario, float aspect) {
    render::Camera camera;
    render::frameSphere(camera, scenario.focus, scenario.focusRadius, aspect, 1.0F);
    return camera;
}

}  // namespace lutka::scene
