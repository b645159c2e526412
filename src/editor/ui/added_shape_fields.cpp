/// The Body tab's last fields: the shapes that a body has beside its main one.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <utility>

#include "editor/document/body_shape.hpp"
#include "editor/ui/part_fields.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using physics::AddedShape;
using AddedKind = physics::PrimitiveShape::Kind;

constexpr const char* kAddedKinds[] = {"Capsule", "Box", "Sphere", "Hull"};

/// A further shape of the active body: what the fields of all selected bodies show.
struct Added {
    const PartFields& fields;
    std::size_t index;
    AddedShape now;                 // copies: an edit takes the profile away
    std::optional<AddedShape> was;  // as fitted, or as the opened file has it; none: it was added since

    // A field's name that no other field has.
    [[nodiscard]] std::string id(const char* label) const { return fmt::format("##{}{}", label, index); }
    // What was is told for shapes of the same kind only.
    [[nodiscard]] bool sameKind() const { return was && was->kind == now.kind; }
};

std::optional<AddedShape> fittedShape(const physics::BodyProfile& body, std::size_t index) {
    if (index >= body.shape.more.size()) return std::nullopt;
    return body.shape.more[index];
}

// Of all selected bodies that have a shape of that index.
void changeShape(const Added& added, const char* what, const std::function<void(AddedShape&)>& change) {
    const std::string name = fmt::format("{} of shape {}", what, added.index + 2);
    added.fields.change(name, [&](EditorDocument::Part& part) -> Result<void> {
        if (added.index < part.body.shape.more.size()) change(part.body.shape.more[added.index]);
        return {};
    });
}

// Each as its own body was fitted.
void takeBack(const Added& added, const char* what, const std::function<void(AddedShape&, const AddedShape&)>& change) {
    const std::string name = fmt::format("{} of shape {}", what, added.index + 2);
    added.fields.change(name, [&](EditorDocument::Part& part) -> Result<void> {
        const std::optional<AddedShape> was = fittedShape(added.fields.fittedOf(part), added.index);
        if (was && added.index < part.body.shape.more.size()) change(part.body.shape.more[added.index], *was);
        return {};
    });
}

/// A length of a shape.
struct Length {
    const char* label;
    float least;
    float (*get)(const AddedShape&);
    void (*set)(AddedShape&, float);
};

constexpr float kThinnest = 0.005F;  // metres
constexpr Length kRadius{"Radius", kThinnest, [](const AddedShape& s) { return s.radius; },
                         [](AddedShape& s, float value) { setRadius(s, value); }};
constexpr Length kLength{"Length", kThinnest, [](const AddedShape& s) { return 2.0F * (s.halfLength + s.radius); },
                         [](AddedShape& s, float value) { s.halfLength = std::max(0.5F * value - s.radius, 0.0F); }};
constexpr Length kSides[] = {{"Half width", kThinnest, [](const AddedShape& s) { return s.halfExtents.x; },
                              [](AddedShape& s, float value) { s.halfExtents.x = value; }},
                             {"Half height", kThinnest, [](const AddedShape& s) { return s.halfExtents.y; },
                              [](AddedShape& s, float value) { s.halfExtents.y = value; }},
                             {"Half depth", kThinnest, [](const AddedShape& s) { return s.halfExtents.z; },
                              [](AddedShape& s, float value) { s.halfExtents.z = value; }}};

void lengthField(const Added& added, const Length& length, float least) {
    const float most = std::max(added.fields.context.editor.document().state().profile.heightM * 0.5F, 2.0F * least);
    const float now = length.get(added.now);
    float cm = now * 100.0F;
    fieldRow(added.fields, length.label);
    if (slider(added.id(length.label).c_str(), cm, least * 100.0F, most * 100.0F, "%.1f cm"))
        changeShape(added, length.label, [&](AddedShape& shape) { length.set(shape, std::max(cm * 0.01F, least)); });
    const float was = added.sameKind() ? length.get(*added.was) : now;
    constexpr float kNoticed = 1e-5F;
    const bool changed = std::abs(now - was) > kNoticed;
    if (wasText(added.fields, added.id(length.label).c_str(), changed, fmt::format("{:.1f} cm", was * 100.0F)))
        takeBack(added, length.label, [&](AddedShape& s, const AddedShape& old) { length.set(s, length.get(old)); });
}

void sizeFields(const Added& added) {
    if (added.now.kind == AddedKind::box) {
        for (const Length& side : kSides)
            lengthField(added, side, side.least);
        return;
    }
    if (added.now.kind == AddedKind::hull) return;  // its corners are no fields
    lengthField(added, kRadius, kRadius.least);
    if (added.now.kind == AddedKind::capsule) lengthField(added, kLength, 2.0F * added.now.radius);
}

void offsetOf(const Added& added) {
    vec3 offset = added.now.bodyFromShape.translation * 100.0F;
    fieldRow(added.fields, "Offset");
    const float far = 200.0F * added.fields.context.editor.document().state().profile.heightM;
    if (ImGui::DragFloat3(added.id("offset").c_str(), &offset.x, 0.1F, -far, far, "%.1f"))
        changeShape(added, "Offset", [&](AddedShape& s) { s.bodyFromShape.translation = offset * 0.01F; });
    tooltip("Centimetres from the middle of the main shape, along its axes");
    if (!added.was) return;
    const vec3 was = added.was->bodyFromShape.translation;
    constexpr float kMoved = 5e-5F;
    const bool moved = glm::distance(was, added.now.bodyFromShape.translation) > kMoved;
    const std::string told = fmt::format("{:.0f} {:.0f} {:.0f}", was.x * 100.0F, was.y * 100.0F, was.z * 100.0F);
    if (!wasText(added.fields, added.id("offset").c_str(), moved, told)) return;
    takeBack(added, "Offset",
             [](AddedShape& s, const AddedShape& old) { s.bodyFromShape.translation = old.bodyFromShape.translation; });
}

void turnOf(const Added& added) {
    vec3 turned = degreesOf(added.now.bodyFromShape.rotation);
    fieldRow(added.fields, "Turned");
    if (ImGui::DragFloat3(added.id("turned").c_str(), &turned.x, 0.5F, -180.0F, 180.0F, "%.0f°"))
        changeShape(added, "Turn", [&](AddedShape& s) { s.bodyFromShape.rotation = rotationFromDegrees(turned); });
    tooltip("How it is turned about the main shape's axes");
    if (!added.was) return;
    const vec3 was = degreesOf(added.was->bodyFromShape.rotation);
    constexpr float kTurned = 1e-6F;  // of a quaternion's dot product: a tenth of a degree
    const float same = std::abs(glm::dot(added.was->bodyFromShape.rotation, added.now.bodyFromShape.rotation));
    const std::string told = fmt::format("{:.0f} {:.0f} {:.0f}", was.x, was.y, was.z);
    if (!wasText(added.fields, added.id("turned").c_str(), same < 1.0F - kTurned, told)) return;
    takeBack(added, "Turn",
             [](AddedShape& s, const AddedShape& old) { s.bodyFromShape.rotation = old.bodyFromShape.rotation; });
}

void kindOf(const Added& added) {
    fieldRow(added.fields, fmt::format("Shape {}", added.index + 2).c_str());
    int kind = static_cast<int>(added.now.kind);
    const auto set = [&](AddedKind wanted) { changeShape(added, "Kind", [&](AddedShape& s) { setKind(s, wanted); }); };
    if (ImGui::Combo(added.id("kind").c_str(), &kind, kAddedKinds, 4)) set(static_cast<AddedKind>(kind));
    const bool changed = added.was && !added.sameKind();
    if (!wasText(added.fields, added.id("kind").c_str(), changed,
                 kAddedKinds[changed ? static_cast<int>(added.was->kind) : 0])) {
        return;
    }
    takeBack(added, "Kind", [](AddedShape& s, const AddedShape& old) {
        const RigidTransform place = s.bodyFromShape;
        s = old;
        s.bodyFromShape = place;
    });
}

// Whether the shape is still there.
bool drawAdded(const PartFields& fields, std::size_t index) {
    const Added added{fields, index, fields.profile().shape.more[index], fittedShape(fields.fitted(), index)};
    const std::uint64_t shown = fields.context.editor.document().revision();
    kindOf(added);
    if (fields.context.editor.document().revision() != shown) return true;  // its measures are others now
    sizeFields(added);
    offsetOf(added);
    turnOf(added);
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
    // The fields of one that was added may be below the end of a low panel.
    if (std::exchange(fields.context.state.shapeAdded, false)) ImGui::SetScrollHereY(1.0F);
    if (fields.profile().shape.more.size() >= physics::BodyShape::kMostAdded) return;
    for (const AddedKind kind : {AddedKind::sphere, AddedKind::capsule, AddedKind::box}) {
        if (ImGui::SmallButton(fmt::format("Add {}", kAddedKinds[static_cast<int>(kind)]).c_str())) {
            fields.change("Add a shape", [&](EditorDocument::Part& part) { return addShape(part.body.shape, kind); });
            fields.context.state.shapeAdded = true;
        }
        tooltip("The body is the union of its shapes, three at most; its middle stays that of the main one");
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

}  // namespace lutka::editor
