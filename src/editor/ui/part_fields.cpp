#include "editor/ui/part_fields.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/document/body_shape.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "physics/fit/edit_bodies.hpp"

namespace lutka::editor {
namespace {

constexpr float kLabelWidth = 108.0F;
constexpr float kWasWidth = 62.0F;
constexpr float kLeast = 0.005F;  // metres

const DocumentState& stateOf(const PartFields& fields) {
    return fields.context.editor.document().state();
}

// A length as centimetres; whether it was changed.
bool slideCm(const char* id, float& metres, float least, float most) {
    float cm = metres * 100.0F;
    if (!slider(id, cm, least * 100.0F, most * 100.0F, "%.1f cm")) return false;
    metres = std::max(cm * 0.01F, least);
    return true;
}

std::string cm(float metres) {
    return fmt::format("{:.1f} cm", metres * 100.0F);
}

// One measure of the shape, by how it is read and written.
struct Measure {
    const char* label;
    float (*get)(const physics::BodyShape&);
    void (*set)(physics::BodyShape&, float);
};

constexpr Measure kRadius{"Radius", [](const physics::BodyShape& s) { return s.radius; },
                          [](physics::BodyShape& s, float value) { setRadius(s, value); }};
// Of a capsule from end to end, as one sees it.
constexpr Measure kLength{
    "Length", [](const physics::BodyShape& s) { return (s.halfLength + s.radius) * 2.0F; },
    [](physics::BodyShape& s, float value) { s.halfLength = std::max(value * 0.5F - s.radius, 0.0F); }};
constexpr Measure kWidth{"Half width", [](const physics::BodyShape& s) { return s.halfExtents.x; },
                         [](physics::BodyShape& s, float value) { s.halfExtents.x = value; }};
constexpr Measure kHeight{"Half height", [](const physics::BodyShape& s) { return s.halfExtents.y; },
                          [](physics::BodyShape& s, float value) { s.halfExtents.y = value; }};
constexpr Measure kDepth{"Half depth", [](const physics::BodyShape& s) { return s.halfExtents.z; },
                         [](physics::BodyShape& s, float value) { s.halfExtents.z = value; }};

void measureField(const PartFields& fields, const Measure& measure, float least, float most) {
    const physics::BodyShape now = fields.profile().shape;  // copies: an edit takes the profile away
    const physics::BodyShape was = fields.fitted().shape;
    float value = measure.get(now);
    fieldRow(fields, measure.label);
    const std::string id = fmt::format("##{}", measure.label);
    if (slideCm(id.c_str(), value, least, most)) {
        fields.change(measure.label, [&](EditorDocument::Part& part) -> Result<void> {
            measure.set(part.body.shape, value);
            return {};
        });
    }
    const bool changed = now.kind == was.kind && std::abs(measure.get(now) - measure.get(was)) > 1e-5F;
    if (wasText(fields, measure.label, changed, cm(measure.get(was)))) {
        fields.change(measure.label, [&](EditorDocument::Part& part) -> Result<void> {
            measure.set(part.body.shape, measure.get(fields.fittedOf(part).shape));
            return {};
        });
    }
}

void massField(const PartFields& fields) {
    const float least = 0.05F;
    float mass = fields.profile().massKg;
    const float was = fields.fitted().massKg;
    fieldRow(fields, "Mass");
    if (slider("##mass", mass, least, stateOf(fields).base.totalMassKg * 0.5F, "%.2f kg", true)) {
        fields.change("Mass", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.massKg = std::max(mass, least);
            return {};
        });
    }
    if (wasText(fields, "mass", fields.profile().massKg != was, fmt::format("{:.2f} kg", was))) {
        fields.change("Mass", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.massKg = fields.fittedOf(part).massKg;
            return {};
        });
    }
}

constexpr const char* kShapeKinds[] = {"Capsule", "Box", "Sphere", "Hull"};

// As the fit has it where it is of that kind; a hull of the skin; else as large as the old one.
Result<void> takeKind(const PartFields& fields, EditorDocument::Part& part, physics::BodyShape::Kind wanted) {
    using Kind = physics::BodyShape::Kind;
    const physics::BodyProfile& fitted = fields.fittedOf(part);
    const physics::PrimitiveShape& fittedMain = fitted.shape;
    if (fitted.shape.kind == wanted) {
        const bool placed = part.body.shape.kind == Kind::hull || wanted == Kind::hull;
        if (placed) part.body.jointFromBody = fitted.jointFromBody;
        static_cast<physics::PrimitiveShape&>(part.body.shape) = fittedMain;  // the further ones stay
        return {};
    }
    if (wanted == Kind::hull) return takeHullOfSkin(fields, part);
    // A hull stands elsewhere in the joint than what the fit has there.
    if (part.body.shape.kind == Kind::hull && fitted.shape.kind != Kind::hull) {
        part.body.jointFromBody = fitted.jointFromBody;
        static_cast<physics::PrimitiveShape&>(part.body.shape) = fittedMain;
    }
    setKind(part.body.shape, wanted);
    return {};
}

}  // namespace

Result<void> takeHullOfSkin(const PartFields& fields, EditorDocument::Part& part) {
    const EditorDocument& document = fields.context.editor.document();
    const int body = physics::bodyNamed(document.profile(), part.body.name);
    auto hull = physics::hullOfSkin(document.profile(), document.character(), document.state().map, body);
    if (!hull) return hull.error();
    part.body.shape = hull.value().shape;  // alone: it holds all of the skin
    part.body.jointFromBody = hull.value().jointFromBody;
    return {};
}

const physics::BodyProfile& PartFields::profile() const {
    return context.editor.document().profile().bodies[body()];
}

const physics::BodyProfile& PartFields::fitted() const {
    return context.editor.document().state().base.bodies[body()];
}

const PartEdits& PartFields::edits() const {
    static const PartEdits kNone;
    const AllPartEdits& edits = context.editor.document().state().edits;
    const auto found = edits.find(profile().name);
    return found == edits.end() ? kNone : found->second;
}

const physics::ConstraintProfile& PartFields::constraint() const {
    return context.editor.document().profile().constraints[body() - 1];
}

const physics::ConstraintProfile& PartFields::fittedConstraint() const {
    return context.editor.document().state().base.constraints[body() - 1];
}

physics::BindFrames PartFields::bind() const {
    const auto& bind = context.editor.document().asset().rig.bindModelFromBody;
    return {bind[constraint().parent], bind[constraint().child]};
}

physics::BindFrames PartFields::fittedBind() const {
    const auto& edited = context.editor.document().profile().bodies;
    const auto& base = context.editor.document().state().base.bodies;
    const auto back = [&](const RigidTransform& present, int index) {
        return present * inverse(edited[index].jointFromBody) * base[index].jointFromBody;
    };
    const physics::BindFrames now = bind();
    return {back(now.fromParent, constraint().parent), back(now.fromChild, constraint().child)};
}

void PartFields::change(const std::string& what,
                        const std::function<Result<void>(EditorDocument::Part&)>& change) const {
    const std::string group = fmt::format("{} {}", what, body());
    context.editor.edit([&](EditorDocument& document) { return document.changeParts(bodies, what, group, change); });
}

bool PartFields::across(const EditorDocument::Part& part) const {
    const physics::RagdollProfile& all = context.editor.document().profile();
    const animation::Side mine = physics::sideOf(all, body());
    const animation::Side other = physics::sideOf(all, physics::bodyNamed(all, part.body.name));
    return mine != other && mine != animation::Side::center && other != animation::Side::center;
}

const physics::BodyProfile& PartFields::fittedOf(const EditorDocument::Part& part) const {
    const physics::RagdollProfile& base = context.editor.document().state().base;
    return base.bodies[physics::bodyNamed(base, part.body.name)];
}

const physics::ConstraintProfile* PartFields::fittedConstraintOf(const EditorDocument::Part& part) const {
    const physics::RagdollProfile& base = context.editor.document().state().base;
    const int index = physics::bodyNamed(base, part.body.name);
    return index > 0 ? &base.constraints[index - 1] : nullptr;
}

float PartFields::labelWidth() const {
    return context.px(kLabelWidth);
}

float PartFields::fieldWidth() const {
    return ImGui::GetContentRegionAvail().x - context.px(kWasWidth);
}

void fieldRow(const PartFields& fields, const char* label) {
    labelled(label, fields.labelWidth());
    ImGui::SetNextItemWidth(fields.fieldWidth());
}

bool wasText(const PartFields& fields, const char* id, bool changed, const std::string& was) {
    if (!changed) return false;
    ImGui::SameLine(0.0F, fields.context.px(4));
    ImGui::PushID(id);
    ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    ImGui::PushStyleColor(ImGuiCol_Button, 0U);
    const bool clicked = ImGui::SmallButton((was + "##was").c_str());
    ImGui::PopStyleColor(2);
    tooltip("It was " + was + ". Click to take the change back.");
    ImGui::PopID();
    return clicked;
}

void drawShapeFields(const PartFields& fields) {
    physics::BodyShape shape = fields.profile().shape;  // copies: an edit takes the profile away
    const physics::BodyShape was = fields.fitted().shape;
    const float most = stateOf(fields).profile.heightM * 0.25F;
    using Kind = physics::BodyShape::Kind;
    fieldRow(fields, "Shape");
    int kind = static_cast<int>(shape.kind);
    const auto change = [&](Kind wanted) {
        fields.change("Shape", [&, wanted](EditorDocument::Part& part) { return takeKind(fields, part, wanted); });
    };
    if (ImGui::Combo("##kind", &kind, kShapeKinds, 4)) change(static_cast<Kind>(kind));
    if (wasText(fields, "kind", shape.kind != was.kind, kShapeKinds[static_cast<int>(was.kind)])) change(was.kind);
    shape = fields.profile().shape;  // as it is from now on
    massField(fields);
    // Every kind takes the lines of a box, so that what follows stays in its place.
    constexpr int lines = 3;
    int used = 1;
    if (shape.kind == Kind::hull) {
        const vec3 size = 100.0F * (shape.hull->high() - shape.hull->low());
        fieldRow(fields, "Size");
        ImGui::TextUnformatted(fmt::format("{:.1f} × {:.1f} × {:.1f} cm", size.x, size.y, size.z).c_str());
        fieldRow(fields, "Corners");
        ImGui::TextUnformatted(fmt::format("{}", shape.hull->points().size()).c_str());
        tooltip("The convex hull of the body's skin. S scales it, Refit makes it anew.");
        ImGui::Dummy({1.0F, ImGui::GetFrameHeight()});
        return;
    }
    if (shape.kind == Kind::box) {
        measureField(fields, kWidth, kLeast, most);
        measureField(fields, kHeight, kLeast, most);
        measureField(fields, kDepth, kLeast, most);
        return;
    }
    measureField(fields, kRadius, kLeast, most);
    if (shape.kind == Kind::capsule) {
        measureField(fields, kLength, shape.radius * 2.0F, most * 3.0F);
        ++used;
    }
    for (; used < lines; ++used)
        ImGui::Dummy({1.0F, ImGui::GetFrameHeight()});
}

}  // namespace lutka::editor
