/// The Body tab's last fields: the shapes that a body has beside its main one.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <glm/gtx/euler_angles.hpp>

#include "editor/document/body_shape.hpp"
#include "editor/ui/part_fields.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using physics::AddedShape;
using AddedKind = physics::PrimitiveShape::Kind;

constexpr float kThinnest = 0.005F;  // metres
constexpr const char* kAddedKinds[] = {"Capsule", "Box", "Sphere"};

// Of all selected bodies that have a shape of that index.
void changeShape(const PartFields& fields, const char* what, std::size_t index,
                 const std::function<void(AddedShape&)>& change) {
    fields.change(fmt::format("{} of shape {}", what, index + 2), [&](EditorDocument::Part& part) -> Result<void> {
        if (index < part.body.shape.more.size()) change(part.body.shape.more[index]);
        return {};
    });
}

// A length in centimetres.
void lengthField(const PartFields& fields, const char* label, std::size_t index, float now, float least,
                 const std::function<void(AddedShape&, float)>& set) {
    const float most = std::max(fields.context.editor.document().state().profile.heightM * 0.5F, 2.0F * least);
    float cm = now * 100.0F;
    fieldRow(fields, label);
    if (!slider(fmt::format("##{}{}", label, index).c_str(), cm, least * 100.0F, most * 100.0F, "%.1f cm")) return;
    changeShape(fields, label, index, [&](AddedShape& shape) { set(shape, std::max(cm * 0.01F, least)); });
}

void sizeFields(const PartFields& fields, std::size_t index, const AddedShape& shape) {
    if (shape.kind == AddedKind::box) {
        constexpr const char* kSides[] = {"Half width", "Half height", "Half depth"};
        for (int axis = 0; axis < 3; ++axis)
            lengthField(fields, kSides[axis], index, shape.halfExtents[axis], kThinnest,
                        [axis](AddedShape& s, float value) { s.halfExtents[axis] = value; });
        return;
    }
    lengthField(fields, "Radius", index, shape.radius, kThinnest,
                [](AddedShape& s, float value) { setRadius(s, value); });
    if (shape.kind != AddedKind::capsule) return;
    lengthField(fields, "Length", index, 2.0F * (shape.halfLength + shape.radius), 2.0F * shape.radius,
                [](AddedShape& s, float value) { s.halfLength = std::max(0.5F * value - s.radius, 0.0F); });
}

void placeOf(const PartFields& fields, std::size_t index, const AddedShape& shape) {
    vec3 offset = shape.bodyFromShape.translation * 100.0F;
    fieldRow(fields, "Offset");
    const float far = 200.0F * fields.context.editor.document().state().profile.heightM;
    if (ImGui::DragFloat3(fmt::format("##offset{}", index).c_str(), &offset.x, 0.1F, -far, far, "%.1f"))
        changeShape(fields, "Offset", index, [&](AddedShape& s) { s.bodyFromShape.translation = offset * 0.01F; });
    tooltip("Centimetres from the middle of the main shape, along its axes");
    vec3 angles(0);
    glm::extractEulerAngleXYZ(glm::mat4_cast(shape.bodyFromShape.rotation), angles.x, angles.y, angles.z);
    vec3 turned(degrees(angles.x), degrees(angles.y), degrees(angles.z));
    fieldRow(fields, "Turned");
    if (ImGui::DragFloat3(fmt::format("##turned{}", index).c_str(), &turned.x, 0.5F, -180.0F, 180.0F, "%.0f°")) {
        const quat turn =
            glm::normalize(glm::quat_cast(glm::eulerAngleXYZ(radians(turned.x), radians(turned.y), radians(turned.z))));
        changeShape(fields, "Turn", index, [&](AddedShape& s) { s.bodyFromShape.rotation = turn; });
    }
    tooltip("How it is turned about the main shape's axes");
}

// Whether the shape is still there.
bool drawAdded(const PartFields& fields, std::size_t index) {
    const AddedShape shape = fields.profile().shape.more[index];  // a copy: an edit takes the profile away
    fieldRow(fields, fmt::format("Shape {}", index + 2).c_str());
    int kind = static_cast<int>(shape.kind);
    if (ImGui::Combo(fmt::format("##kind{}", index).c_str(), &kind, kAddedKinds, 3)) {
        changeShape(fields, "Kind", index, [&](AddedShape& s) { setKind(s, static_cast<AddedKind>(kind)); });
        return true;
    }
    sizeFields(fields, index, shape);
    placeOf(fields, index, shape);
    if (!ImGui::SmallButton(fmt::format("Remove##{}", index).c_str())) return true;
    fields.change("Remove a shape", [&](EditorDocument::Part& part) -> Result<void> {
        removeShape(part.body.shape, index);
        return {};
    });
    return false;
}

}  // namespace

void drawAddedShapeFields(const PartFields& fields) {
    const std::size_t count = fields.profile().shape.more.size();
    ImGui::SetNextItemOpen(count > 0, ImGuiCond_Once);
    const std::string title = count == 0 ? "More shapes" : fmt::format("More shapes: {}", count);
    constexpr ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen;
    if (!ImGui::TreeNodeEx((title + "###more").c_str(), flags)) return;
    for (std::size_t index = 0; index < fields.profile().shape.more.size(); ++index)
        if (!drawAdded(fields, index)) return;
    if (fields.profile().shape.more.size() >= physics::BodyShape::kMostAdded) return;
    for (const AddedKind kind : {AddedKind::sphere, AddedKind::capsule, AddedKind::box}) {
        if (ImGui::SmallButton(fmt::format("Add {}", kAddedKinds[static_cast<int>(kind)]).c_str())) {
            fields.change("Add a shape", [&](EditorDocument::Part& part) { return addShape(part.body.shape, kind); });
        }
        tooltip("The body is the union of its shapes, three at most; its middle stays that of the main one");
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

}  // namespace lutka::editor
