/// The tab of the selected body: its shape and mass, its joint's limits with the present angle, or an object's values.

#include <fmt/format.h>
#include <imgui.h>

#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "physics/quality.hpp"

namespace lutka::editor {
namespace {

using physics::ConstraintProfile;

constexpr float kNearLimit = radians(5.0F);

float labelWidth(const PanelContext& context) {
    return context.px(92);
}

// Centimetres read better than metres on a body's scale.
bool sliderCm(const PanelContext& context, const char* label, float& metres, float least, float most) {
    labelled(label, labelWidth(context));
    float cm = metres * 100.0F;
    const std::string id = fmt::format("##{}", label);
    if (!ImGui::SliderFloat(id.c_str(), &cm, least * 100.0F, most * 100.0F, "%.1f cm")) return false;
    metres = std::max(cm * 0.01F, least);
    return true;
}

struct DegreeRange {
    float least;
    float most;
    float zero = 0.0F;  // the angle, in radians, that is shown as 0
};

bool sliderDegrees(const PanelContext& context, const char* label, float& angle, const DegreeRange& range,
                   const char* what) {
    labelled(label, labelWidth(context));
    const float zero = degrees(range.zero);
    float shown = degrees(angle) - zero;
    const std::string id = fmt::format("##{}", label);
    const bool moved = ImGui::SliderFloat(id.c_str(), &shown, range.least - zero, range.most - zero, "%.0f°");
    tooltip(what);
    if (!moved) return false;
    angle = radians(std::clamp(shown + zero, range.least, range.most));
    return true;
}

// Flexion where the bind pose has the hinge: people tell limits from there, not from the middle of the range.
float bindAngle(const PanelContext& context, const ConstraintProfile& constraint) {
    const auto& bind = context.editor.document().asset().rig.bindModelFromBody;
    return physics::measureConstraint(constraint, bind[constraint.parent], bind[constraint.child]).hingeAngle;
}

// What the user changed, as it was: below all sliders, so that none moves away under the mouse.
void drawBefore(const PanelContext& context, int body) {
    const DocumentState& state = context.editor.document().state();
    const PartEdits& edits = state.edits[animation::indexOf(state.profile.bodies[body].role)];
    if (!edits.any()) return;
    const physics::BodyProfile& fitted = state.base.bodies[body];
    caption("AS FITTED");
    if (edits.shape) {
        mutedText(fmt::format("radius {:.1f} cm, length {:.1f} cm", fitted.shape.radius * 100.0F,
                              (fitted.shape.halfLength + fitted.shape.radius) * 200.0F));
    }
    if (edits.massKg) mutedText(fmt::format("mass {:.2f} kg", fitted.massKg));
    if (body == 0) return;
    const ConstraintProfile& constraint = state.base.constraints[body - 1];
    const float zero = bindAngle(context, constraint);
    if (edits.hinge) {
        mutedText(fmt::format("limits {:.0f}° to {:.0f}°", degrees(constraint.hinge.lower - zero),
                              degrees(constraint.hinge.upper - zero)));
    }
    if (edits.cone) {
        mutedText(fmt::format("flexion ±{:.0f}°, sideways ±{:.0f}°, twist ±{:.0f}°", degrees(constraint.cone.swingZ),
                              degrees(constraint.cone.swingY), degrees(constraint.cone.twist)));
    }
    if (edits.frictionNm) mutedText(fmt::format("friction {:.2f} N m", constraint.frictionNm));
}

void drawShape(const PanelContext& context, int body) {
    Editor& editor = context.editor;
    const DocumentState& state = editor.document().state();
    physics::BodyShape shape = state.profile.bodies[body].shape;
    const float most = state.profile.heightM * 0.25F;
    constexpr float least = 0.005F;
    bool changed = false;
    using Kind = physics::BodyShape::Kind;
    constexpr const char* kinds[] = {"Capsule", "Box", "Sphere"};
    labelled("Shape", labelWidth(context));
    int kind = static_cast<int>(shape.kind);
    if (ImGui::Combo("##kind", &kind, kinds, 3)) {
        shape.kind = static_cast<Kind>(kind);
        changed = true;
    }
    if (shape.kind != Kind::box) changed |= sliderCm(context, "Radius", shape.radius, least, most);
    if (shape.kind == Kind::capsule) {
        float length = (shape.halfLength + shape.radius) * 2.0F;
        if (sliderCm(context, "Length", length, shape.radius * 2.0F, most * 3.0F)) {
            shape.halfLength = std::max(length * 0.5F - shape.radius, 0.0F);
            changed = true;
        }
    }
    if (shape.kind == Kind::box) {
        changed |= sliderCm(context, "Half width", shape.halfExtents.x, least, most);
        changed |= sliderCm(context, "Half height", shape.halfExtents.y, least, most);
        changed |= sliderCm(context, "Half depth", shape.halfExtents.z, least, most);
    }
    if (changed) {
        editor.edit(
            [&](EditorDocument& document) { return document.setShape(body, shape, fmt::format("shape {}", body)); });
    }
}

void drawMass(const PanelContext& context, int body) {
    const DocumentState& state = context.editor.document().state();
    float mass = state.profile.bodies[body].massKg;
    labelled("Mass", labelWidth(context));
    if (ImGui::SliderFloat("##mass", &mass, 0.05F, state.base.totalMassKg * 0.5F, "%.2f kg",
                           ImGuiSliderFlags_Logarithmic)) {
        context.editor.edit([&](EditorDocument& document) {
            return document.setMass(body, std::max(mass, 0.05F), fmt::format("mass {}", body));
        });
    }
}

// The present angle as a mark between the limits.
void angleBar(const PanelContext& context, const char* label, float angle, float lower, float upper,
              float zero = 0.0F) {
    labelled(label, labelWidth(context));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetFrameHeight();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = at.y + height * 0.5F;
    const float past = std::max(lower - angle, angle - upper);
    const ImVec4 color = past > 0.0F ? errorColor() : past > -kNearLimit ? warningColor() : goodColor();
    list->AddRectFilled({at.x, middle - 3}, {at.x + width, middle + 3}, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0F);
    const float along = std::clamp((angle - lower) / std::max(upper - lower, 1e-4F), 0.0F, 1.0F);
    list->AddCircleFilled({at.x + along * width, middle}, height * 0.24F, ImGui::GetColorU32(color));
    ImGui::Dummy({width, height});
    tooltip(fmt::format("now {:.0f}°, between {:.0f}° and {:.0f}°", degrees(angle - zero), degrees(lower - zero),
                        degrees(upper - zero)));
}

void drawHinge(const PanelContext& context, int constraint, const physics::ConstraintState& now) {
    Editor& editor = context.editor;
    const DocumentState& state = editor.document().state();
    const ConstraintProfile& profile = state.profile.constraints[constraint];
    physics::HingeLimits limits = profile.hinge;
    const float zero = bindAngle(context, profile);
    bool changed = sliderDegrees(context, "Extends to", limits.lower, {-175.0F, 0.0F, zero},
                                 "How far the limb straightens, from the bind pose; below 0 it bends backwards");
    changed |= sliderDegrees(context, "Flexes to", limits.upper, {0.0F, 175.0F, zero},
                             "How far the limb bends, from the bind pose");
    angleBar(context, "Now", now.hingeAngle, profile.hinge.lower, profile.hinge.upper, zero);
    if (changed) {
        editor.edit([&](EditorDocument& document) {
            return document.setHinge(constraint, limits, fmt::format("hinge {}", constraint));
        });
    }
}

void drawCone(const PanelContext& context, int constraint, const physics::ConstraintState& now) {
    Editor& editor = context.editor;
    const DocumentState& state = editor.document().state();
    const ConstraintProfile& profile = state.profile.constraints[constraint];
    physics::ConeTwistLimits limits = profile.cone;
    const DegreeRange range{1.0F, 175.0F};
    bool changed = sliderDegrees(context, "Flexion ±", limits.swingZ, range,
                                 "Forward and back from the middle of the range (swing about the frame's z)");
    changed |= sliderDegrees(context, "Sideways ±", limits.swingY, range,
                             "To the sides from the middle of the range (swing about the frame's y)");
    changed |= sliderDegrees(context, "Twist ±", limits.twist, range,
                             "About the limb's own axis from the middle of the range");
    angleBar(context, "Flexion now", now.swing.z, -profile.cone.swingZ, profile.cone.swingZ);
    angleBar(context, "Side now", now.swing.y, -profile.cone.swingY, profile.cone.swingY);
    angleBar(context, "Twist now", now.twist, -profile.cone.twist, profile.cone.twist);
    if (changed) {
        editor.edit([&](EditorDocument& document) {
            return document.setCone(constraint, limits, fmt::format("cone {}", constraint));
        });
    }
}

void drawConstraint(const PanelContext& context, const Item& item) {
    Editor& editor = context.editor;
    const int constraint = item.index - 1;
    const ConstraintProfile& profile = editor.document().profile().constraints[constraint];
    const auto bodies = editor.player().simulation().worldFromBody(item.doll);
    const auto now = physics::measureConstraint(profile, bodies[profile.parent], bodies[profile.child]);
    const bool hinge = profile.kind == ConstraintProfile::Kind::hinge;
    const auto& parent = editor.document().profile().bodies[profile.parent];
    caption(fmt::format("JOINT: {} TO {}", hinge ? "HINGE" : "CONE-TWIST", animation::roleName(parent.role)).c_str());
    if (hinge) {
        drawHinge(context, constraint, now);
    } else {
        drawCone(context, constraint, now);
    }
    float friction = profile.frictionNm;
    labelled("Friction", labelWidth(context));
    if (ImGui::SliderFloat("##friction", &friction, 0.0F, 20.0F, "%.2f N m")) {
        editor.edit([&](EditorDocument& document) {
            return document.setFriction(constraint, friction, fmt::format("friction {}", constraint));
        });
    }
    const ImVec4 color = now.separationM > 0.01F ? warningColor() : mutedColor();
    ImGui::TextColored(color, "separation %.1f mm", static_cast<double>(now.separationM * 1000.0F));
}

void drawBody(const PanelContext& context, const Item& item) {
    Editor& editor = context.editor;
    const physics::BodyProfile& body = editor.document().profile().bodies[item.index];
    ImGui::PushFont(context.fonts.heading);
    ImGui::TextUnformatted(std::string(animation::roleName(body.role)).c_str());
    ImGui::PopFont();
    mutedText("joint " + body.joint);
    const bool pinned = editor.workspace().pulls.findPin(item.doll, body.role) != editor.workspace().pulls.pins.end();
    if (ImGui::Button(pinned ? "Unpin" : "Pin")) editor.perform(Action::pin);
    ImGui::SameLine();
    if (ImGui::Button("Focus")) editor.perform(Action::focus);
    const int edited = animation::indexOf(body.role);
    if (animation::sideOf(body.role) != animation::Side::center) {
        ImGui::SameLine();
        if (ImGui::Button("Mirror")) {
            editor.edit([&](EditorDocument& document) { return document.mirrorPart(item.index); });
        }
        tooltip("Gives the other side these values");
    }
    if (editor.document().state().edits[edited].any()) {
        ImGui::SameLine();
        if (ImGui::Button("As fitted")) {
            editor.edit([&](EditorDocument& document) { return document.resetPart(item.index); });
        }
        tooltip("Forgets your changes of this body and its joint");
    }
    caption("BODY");
    drawShape(context, item.index);
    drawMass(context, item.index);
    if (item.index > 0) {
        drawConstraint(context, item);
    } else {
        mutedText("The root of the ragdoll: it hangs on nothing.");
    }
    drawBefore(context, item.index);
}

void drawObject(const PanelContext& context, const Item& item) {
    Editor& editor = context.editor;
    SceneSettings scene = editor.document().state().scene;
    SceneObject& object = scene.objects[item.index];
    ImGui::PushFont(context.fonts.heading);
    ImGui::TextUnformatted(editor.workspace().nameOf(item).c_str());
    ImGui::PopFont();
    labelled("Position", labelWidth(context));
    bool changed = ImGui::DragFloat3("##position", &object.worldFromObject.translation.x, 0.01F, -50, 50, "%.2f");
    constexpr float least = 0.01F;
    switch (object.kind) {
        case SceneObject::Kind::box:
            labelled("Half size", labelWidth(context));
            changed |= ImGui::DragFloat3("##size", &object.halfExtents.x, 0.005F, least, 20.0F, "%.2f");
            break;
        case SceneObject::Kind::ball:
            changed |= sliderCm(context, "Radius", object.radius, least, 1.0F);
            labelled("Mass", labelWidth(context));
            changed |=
                ImGui::SliderFloat("##ballMass", &object.massKg, 0.1F, 200.0F, "%.1f kg", ImGuiSliderFlags_Logarithmic);
            break;
        case SceneObject::Kind::light:
            labelled("Colour", labelWidth(context));
            changed |= ImGui::ColorEdit3("##color", &object.lightColor.x, ImGuiColorEditFlags_Float);
            labelled("Intensity", labelWidth(context));
            changed |= ImGui::SliderFloat("##intensity", &object.lightIntensity, 0.0F, 50.0F, "%.1f");
            break;
    }
    if (changed) {
        editor.edit([&](EditorDocument& document) {
            return document.setScene(scene, "Edit " + editor.workspace().nameOf(item),
                                     fmt::format("object {}", item.index));
        });
    }
}

void drawTable(const PanelContext& context) {
    Editor& editor = context.editor;
    const physics::RagdollProfile& profile = editor.document().profile();
    mutedText(fmt::format("{:.2f} m, {:.1f} kg, {} bodies. Click one to edit it.", profile.heightM, profile.totalMassKg,
                          profile.bodies.size()));
    if (!ImGui::BeginTable("##bodies", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("Body", 0, 2.7F);
    ImGui::TableSetupColumn("Mass", 0, 1.6F);
    ImGui::TableSetupColumn("Flex, side, twist", 0, 3.3F);
    ImGui::TableHeadersRow();
    for (int i = 0; i < static_cast<int>(profile.bodies.size()); ++i) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string name(animation::roleName(profile.bodies[i].role));
        if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
            editor.select(Item{Item::Kind::body, 0, i});
        }
        ImGui::TableNextColumn();
        ImGui::Text("%.2f kg", static_cast<double>(profile.bodies[i].massKg));
        ImGui::TableNextColumn();
        if (i == 0) continue;
        const ConstraintProfile& c = profile.constraints[i - 1];
        const float zero = bindAngle(context, c);
        const std::string limits =
            c.kind == ConstraintProfile::Kind::hinge
                ? fmt::format("{:.0f}° to {:.0f}°", degrees(c.hinge.lower - zero), degrees(c.hinge.upper - zero))
                : fmt::format("±{:.0f}  ±{:.0f}  ±{:.0f}°", degrees(c.cone.swingZ), degrees(c.cone.swingY),
                              degrees(c.cone.twist));
        ImGui::TextColored(mutedColor(), "%s", limits.c_str());
    }
    ImGui::EndTable();
}

}  // namespace

void drawRagdollTab(const PanelContext& context) {
    const auto active = context.editor.workspace().selection.active();
    if (!active) {
        drawTable(context);
    } else if (active->kind == Item::Kind::body) {
        drawBody(context, *active);
    } else {
        drawObject(context, *active);
    }
}

}  // namespace lutka::editor
