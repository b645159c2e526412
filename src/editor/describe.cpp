/// What the editor's picture shows: Editor::describe() and its parts.

#include "editor/editor.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kSelection{255, 150, 46, 110};
constexpr render::Color kSelectionLine{255, 150, 46, 255};
constexpr render::Color kPin{90, 200, 255, 255};
constexpr float kLightMarker = 0.12F;  // metres

void drawLight(const SceneObject& object, bool selected, render::FrameDescription& frame) {
    render::LocalLight& light = frame.localLights.emplace_back();
    light.position = object.worldFromObject.translation;
    light.color = object.lightColor;
    light.intensity = object.lightIntensity;
    const render::Color color = selected ? kSelectionLine : render::fromLinear(vec4(object.lightColor, 1.0F));
    render::addSphere(frame.lines, light.position, kLightMarker * 0.5F, color);
    render::addCross(frame.lines, light.position, kLightMarker * 2.0F, color);
}

}  // namespace

void Editor::describe(render::CharacterHandle character, render::FrameDescription& frame) {
    frame.clear();
    frame.camera = workspace_.camera;
    drawer_.skinning =
        view.dualQuaternions ? animation::SkinningMethod::dualQuaternion : animation::SkinningMethod::linear;
    drawer_.draw(player().simulation(), character, view.debug ? view.layers : scene::DebugLayers{}, player().alpha(),
                 view.skinOpacity, frame);
    highlight(frame);
    drawOverlay(frame);
}

void Editor::highlight(render::FrameDescription& frame) const {
    for (const Item& item : workspace_.selection.items()) {
        if (item.kind != Item::Kind::body) continue;
        const int at = drawer_.characterItem(item.doll);
        if (at < 0) continue;
        frame.characters[at].highlight = kSelection;
        frame.characters[at].highlightJoint = document().asset().rig.jointOfBody[item.index];
    }
}

void Editor::drawActivePart(render::FrameDescription& frame) const {
    if (!workspace_.showHandles) return;
    const auto scene = workspace_.handleScene();
    if (!scene) return;
    const std::vector<Handle> handles = handlesOf(*scene, workspace_.camera);
    drawHandles(*scene, handles, workspace_.hotHandle, workspace_.camera, frame.lines);
}

void Editor::drawOverlay(render::FrameDescription& frame) {
    const std::vector<SceneObject> objects = player().presentObjects();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool selected = workspace_.selection.contains({Item::Kind::object, 0, static_cast<int>(i)});
        if (objects[i].kind == SceneObject::Kind::light) {
            drawLight(objects[i], selected, frame);
        } else if (selected && objects[i].kind == SceneObject::Kind::ball) {
            render::addSphere(frame.lines, objects[i].worldFromObject.translation, objects[i].radius * 1.02F,
                              kSelectionLine);
        } else if (selected) {
            render::addBox(frame.lines, objects[i].worldFromObject, halfSizeOf(objects[i]), kSelectionLine);
        }
    }
    for (const Item& item : workspace_.selection.items()) {
        if (item.kind != Item::Kind::body) continue;
        const physics::BodyShape& shape = document().profile().bodies[item.index].shape;
        const RigidTransform frameOfBody = player().simulation().worldFromBody(item.doll, player().alpha())[item.index];
        if (shape.kind == physics::BodyShape::Kind::capsule) {
            render::addCapsule(frame.lines, frameOfBody, shape.radius, shape.halfLength, kSelectionLine);
        } else if (shape.kind == physics::BodyShape::Kind::sphere) {
            render::addSphere(frame.lines, frameOfBody.translation, shape.radius, kSelectionLine);
        } else {
            render::addBox(frame.lines, frameOfBody, shape.halfExtents, kSelectionLine);
        }
    }
    drawActivePart(frame);
    for (const Pull& pin : workspace_.pulls.pins) {
        render::addSphere(frame.lines, pin.target, 0.025F, kPin);
        render::addCross(frame.lines, pin.target, 0.1F, kPin);
    }
    const auto& lines = workspace_.overlay.vertices;
    frame.lines.vertices.insert(frame.lines.vertices.end(), lines.begin(), lines.end());
}

}  // namespace lutka::editor
