/// The Body tab's joint: kind, limits in anatomical words, present angles, friction, spring, strength, and the swing
/// that shows them.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "editor/ui/part_fields.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"
#include "physics/profile/constraint_state.hpp"
#include "scene/draw/draw_debug.hpp"

namespace lutka::editor {
namespace {

using physics::AngleSpan;
using physics::ConstraintProfile;
using physics::JointRange;
using physics::JointSpring;

constexpr float kMostDeg = 175.0F;
constexpr const char* kConstraintKinds[] = {"Hinge", "Cone and twist"};

std::string capital(std::string_view word) {
    std::string text(word);
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

void kindField(const PartFields& fields) {
    const ConstraintProfile::Kind now = fields.constraint().kind;
    const ConstraintProfile::Kind was = fields.fittedConstraint().kind;
    const auto set = [&](ConstraintProfile::Kind kind) {
        fields.change("Kind", [&](EditorDocument::Part& part) -> Result<void> {
            if (part.constraint == nullptr) return {};
            physics::changeKind(*part.constraint, kind, part.bind);
            return {};
        });
    };
    int kind = static_cast<int>(now);
    fieldRow(fields, "Kind");
    if (ImGui::Combo("##constraintKind", &kind, kConstraintKinds, 2)) set(static_cast<ConstraintProfile::Kind>(kind));
    tooltip(
        "A hinge bends about one axis; a cone and twist joint swings in two directions and turns. The flexion stays.");
    if (wasText(fields, "constraintKind", now != was, kConstraintKinds[static_cast<int>(was)])) set(was);
}

/// One of the three turns of a joint.
struct Turn {
    AngleSpan JointRange::*span;
    const physics::MotionWords& words;
    bool flips;  // on the other side of the body
};

void setEnd(const PartFields& fields, const Turn& turn, bool high,
            const std::function<float(EditorDocument::Part&)>& value, std::string_view word) {
    fields.change(capital(word), [&](EditorDocument::Part& part) -> Result<void> {
        if (part.constraint == nullptr) return {};
        constexpr float least = radians(2.0F);  // between the ends
        const bool flipped = turn.flips && fields.across(part);
        JointRange range = physics::jointRange(*part.constraint, part.bind);
        AngleSpan& span = range.*turn.span;
        const float angle = value(part);
        if (high != flipped) {
            span.high = std::max(flipped ? -angle : angle, span.low + least);
        } else {
            span.low = std::min(flipped ? -angle : angle, span.high - least);
        }
        physics::setJointRange(*part.constraint, range, part.bind);
        return {};
    });
}

// A limit as the angle in its own direction: extension 10° is -10° of flexion.
void endField(const PartFields& fields, const Turn& turn, bool high, const JointRange& now, const JointRange& was) {
    const std::string_view word = high ? turn.words.high : turn.words.low;
    const auto read = [&](const JointRange& range) {
        const AngleSpan& span = range.*turn.span;
        return degrees(high ? span.high : -span.low);
    };
    float shown = read(now);
    const std::string label = capital(word);
    fieldRow(fields, label.c_str());
    const std::string id = fmt::format("##{}", word);
    if (slider(id.c_str(), shown, -kMostDeg, kMostDeg, "%.0f°")) {
        const float angle = radians(std::clamp(shown, -kMostDeg, kMostDeg)) * (high ? 1.0F : -1.0F);
        setEnd(
            fields, turn, high, [angle](EditorDocument::Part&) { return angle; }, word);
    }
    tooltip(fmt::format("How far the joint allows {}, from the bind pose", word));
    const bool changed = std::abs(read(now) - read(was)) > 0.1F;
    if (wasText(fields, label.c_str(), changed, fmt::format("{:.0f}°", read(was)))) {
        const AngleSpan& span = was.*turn.span;
        const float angle = high ? span.high : span.low;
        setEnd(
            fields, turn, high, [angle](EditorDocument::Part&) { return angle; }, word);
    }
}

/// Where a joint is in one of its turns, radians from the bind pose.
struct Present {
    float angle, low, high;
};

// Free, limited as fitted, or locked at the bind pose.
void lockMenu(const PartFields& fields, const Turn& turn, const AngleSpan& now, const AngleSpan& fitted) {
    constexpr float most = radians(kMostDeg);
    constexpr float lock = radians(2.5F);  // less than this jitters
    const std::string name(turn.words.name);
    const auto same = [&](const AngleSpan& span) {
        constexpr float tolerance = radians(0.5F);
        return std::abs(span.low - now.low) < tolerance && std::abs(span.high - now.high) < tolerance;
    };
    const std::pair<const char*, AngleSpan> choices[] = {
        {"Free", {-most, most}}, {"Limited, as fitted", fitted}, {"Locked", {-lock, lock}}};
    if (ImGui::SmallButton((name + " ▾").c_str())) ImGui::OpenPopup("##lock");
    tooltip("Free, limited or locked. The mark shows where the joint is now");
    if (!ImGui::BeginPopup("##lock")) return;
    for (const auto& [label, span] : choices) {
        if (!ImGui::MenuItem(label, nullptr, same(span))) continue;
        fields.change(name, [&, wanted = span](EditorDocument::Part& part) -> Result<void> {
            if (part.constraint == nullptr) return {};
            const AngleSpan own = turn.flips && fields.across(part) ? AngleSpan{-wanted.high, -wanted.low} : wanted;
            JointRange range = physics::jointRange(*part.constraint, part.bind);
            range.*turn.span = own;
            physics::setJointRange(*part.constraint, range, part.bind);
            return {};
        });
    }
    ImGui::EndPopup();
}

// The present angle as a mark between the limits, behind the turn's name with its menu.
void presentBar(const PartFields& fields, const Turn& turn, const Present& present, const AngleSpan& fitted) {
    ImGui::PushID(turn.words.name.data());
    lockMenu(fields, turn, {present.low, present.high}, fitted);
    ImGui::PopID();
    ImGui::SameLine(fields.labelWidth());
    ImGui::SetNextItemWidth(fields.fieldWidth());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::CalcItemWidth();
    const float height = ImGui::GetFrameHeight() * 0.72F;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = at.y + height * 0.6F;
    const float past = std::max(present.low - present.angle, present.angle - present.high);
    const ImVec4 color = -past <= scene::kPassedLimit ? errorColor()
                         : -past < scene::kNearLimit  ? warningColor()
                                                      : goodColor();
    list->AddRectFilled({at.x, middle - 3}, {at.x + width, middle + 3}, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0F);
    const float span = std::max(present.high - present.low, 1e-4F);
    const float along = std::clamp((present.angle - present.low) / span, 0.0F, 1.0F);
    list->AddCircleFilled({at.x + along * width, middle}, height * 0.33F, ImGui::GetColorU32(color));
    ImGui::Dummy({width, height});
    tooltip(fmt::format("now {:.0f}°, between {:.0f}° and {:.0f}° from the bind pose", degrees(present.angle),
                        degrees(present.low), degrees(present.high)));
    ImGui::SameLine();
    ImGui::TextColored(mutedColor(), "%d°", static_cast<int>(std::lround(degrees(present.angle))));
}

void limitFields(const PartFields& fields, const physics::ConstraintState& state) {
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): an edit takes the profile away
    const ConstraintProfile constraint = fields.constraint();
    const JointRange now = physics::jointRange(constraint, fields.bind());
    const bool sameKind = constraint.kind == fields.fittedConstraint().kind;
    const JointRange was = sameKind ? physics::jointRange(fields.fittedConstraint(), fields.fittedBind()) : now;
    const physics::JointWords words = physics::jointWords(fields.profile().role);
    const Turn flexion{&JointRange::flexion, words.flexion, false};
    const Turn side{&JointRange::side, words.side, true};
    const Turn twist{&JointRange::twist, words.twist, true};
    const bool hinge = constraint.kind == ConstraintProfile::Kind::hinge;
    // What the constraint calls 0 is the middle of the range.
    const auto present = [](float angle, float limit, const AngleSpan& span) {
        return Present{angle + limit + span.low, span.low, span.high};
    };
    endField(fields, flexion, true, now, was);
    endField(fields, flexion, false, now, was);
    if (hinge) {
        presentBar(fields, flexion, present(state.hingeAngle, -constraint.hinge.lower, now.flexion), was.flexion);
        return;
    }
    presentBar(fields, flexion, present(state.swing.z, constraint.cone.swingZ, now.flexion), was.flexion);
    endField(fields, side, true, now, was);
    endField(fields, side, false, now, was);
    presentBar(fields, side, present(state.swing.y, constraint.cone.swingY, now.side), was.side);
    endField(fields, twist, true, now, was);
    endField(fields, twist, false, now, was);
    presentBar(fields, twist, present(state.twist, constraint.cone.twist, now.twist), was.twist);
}

// How far each selected joint is turned now: where its spring is to rest.
void restNow(const PartFields& fields) {
    const auto bodies = fields.context.editor.player().simulation().worldFromBody(fields.doll);
    fields.change("Spring's rest", [&](EditorDocument::Part& part) -> Result<void> {
        if (part.constraint == nullptr) return {};
        const ConstraintProfile& c = *part.constraint;
        part.constraint->spring.rest = physics::relativeFrame(c, {bodies[c.parent], bodies[c.child]});
        return {};
    });
}

void springValue(const PartFields& fields, const char* label, const char* format, float JointSpring::*member,
                 float most) {
    float value = fields.constraint().spring.*member;
    const std::string id = fmt::format("##{}", label);
    labelled(label, fields.labelWidth());
    if (!slider(id.c_str(), value, 0.0F, most, format)) return;
    fields.change(label, [&](EditorDocument::Part& part) -> Result<void> {
        if (part.constraint == nullptr) return {};
        JointSpring& spring = part.constraint->spring;
        if (!spring.works()) spring.rest = physics::relativeFrame(*part.constraint, part.bind);
        spring.*member = std::max(value, 0.0F);
        return {};
    });
}

void springRest(const PartFields& fields) {
    if (ImGui::MenuItem("Rests in the bind pose")) {
        fields.change("Spring's rest", [](EditorDocument::Part& part) -> Result<void> {
            if (part.constraint == nullptr) return {};
            part.constraint->spring.rest = physics::relativeFrame(*part.constraint, part.bind);
            return {};
        });
    }
    if (ImGui::MenuItem("Rests as it is now")) restNow(fields);
    if (!ImGui::MenuItem("As fitted")) return;
    fields.change("Spring", [&](EditorDocument::Part& part) -> Result<void> {
        const auto* fitted = fields.fittedConstraintOf(part);
        if (fitted != nullptr) part.constraint->spring = fitted->spring;
        return {};
    });
}

// Behind the friction's name, which stands out where there is a spring.
void springMenu(const PartFields& fields) {
    const bool works = fields.constraint().spring.works();
    if (works) ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    ImGui::AlignTextToFramePadding();
    if (ImGui::SmallButton("Friction ▾")) ImGui::OpenPopup("##spring");
    if (works) ImGui::PopStyleColor();
    tooltip("The joint's spring: stiffness, damping, and the pose in which it rests");
    ImGui::SetNextWindowSize({fields.context.px(300), 0.0F});
    if (!ImGui::BeginPopup("##spring")) return;
    caption("SPRING");
    const physics::RagdollProfile& profile = fields.context.editor.document().profile();
    constexpr float gravity = 9.81F;
    const float weight = profile.totalMassKg * gravity * profile.heightM;  // N m, what its torques are measured by
    constexpr float mostStiffness = 0.25F;
    constexpr float mostDamping = 0.02F;
    springValue(fields, "Stiffness", "%.1f N m / rad", &JointSpring::stiffness, mostStiffness * weight);
    springValue(fields, "Damping", "%.2f N m s / rad", &JointSpring::damping, mostDamping * weight);
    ImGui::BeginDisabled(!fields.constraint().spring.works());
    springRest(fields);
    ImGui::EndDisabled();
    ImGui::EndPopup();
}

void frictionField(const PartFields& fields) {
    float friction = fields.constraint().frictionNm;
    const float was = fields.fittedConstraint().frictionNm;
    springMenu(fields);
    ImGui::SameLine(fields.labelWidth());
    ImGui::SetNextItemWidth(fields.fieldWidth());
    if (slider("##friction", friction, 0.0F, 20.0F, "%.2f N m")) {
        fields.change("Friction", [&](EditorDocument::Part& part) -> Result<void> {
            if (part.constraint != nullptr) part.constraint->frictionNm = std::max(friction, 0.0F);
            return {};
        });
    }
    tooltip("The largest torque of dry friction in the joint. More: stiffer, calmer");
    if (wasText(fields, "friction", fields.constraint().frictionNm != was, fmt::format("{:.2f}", was))) {
        fields.change("Friction", [&](EditorDocument::Part& part) -> Result<void> {
            if (const auto* fitted = fields.fittedConstraintOf(part)) part.constraint->frictionNm = fitted->frictionNm;
            return {};
        });
    }
}

// Of the muscle in the joint, as a factor on what the doll has.
void strengthField(const PartFields& fields) {
    float strength = fields.profile().muscle.strength;
    const float was = fields.fitted().muscle.strength;
    fieldRow(fields, "Strength");
    if (slider("##strength", strength, 0.01F, 10.0F, "× %.2f", true)) {
        fields.change("Strength", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.muscle.strength = std::clamp(strength, 0.0F, physics::MuscleFactors::kMost);
            return {};
        });
    }
    tooltip(
        "What the joint's muscle has of the doll's strength, where characters have muscles (Physics) and these are the "
        "profile's own");
    if (wasText(fields, "strength", fields.profile().muscle.strength != was, fmt::format("{:.2f}", was))) {
        fields.change("Strength", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.muscle.strength = fields.fittedOf(part).muscle.strength;
            return {};
        });
    }
}

// At the right of the caption's line; meanwhile it tells how far the swing is, else how far the joint is apart.
void swingButton(const PartFields& fields, const physics::ConstraintState& state) {
    Editor& editor = fields.context.editor;
    const bool swinging = editor.swing() != nullptr;
    const std::string told = swinging                    ? editor.swing()->text()
                             : state.separationM > 0.01F ? fmt::format("apart {:.0f} mm", state.separationM * 1000.0F)
                                                         : "";
    const char* name = swinging ? "Stop" : "Swing";
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const float end = ImGui::GetWindowContentRegionMax().x;
    const float button = ImGui::CalcTextSize("Swing").x + 2.0F * padding.x;
    if (!told.empty()) {
        const float text = ImGui::CalcTextSize(told.c_str()).x + ImGui::GetStyle().ItemSpacing.x;
        ImGui::SameLine(std::max(end - button - text, ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + padding.x));
        ImGui::TextColored(swinging ? accentColor() : warningColor(), "%s", told.c_str());
    }
    ImGui::SameLine(end - button);
    ImGui::PushID("swing");
    if (ImGui::SmallButton(name)) {
        if (swinging) {
            editor.endSwing();
        } else {
            editor.perform(Action::swingLimits);
        }
    }
    ImGui::PopID();
    tooltip(fmt::format(
        "L: swings the joint through its limits while the simulation stands still; the doll ends where it was. "
        "Apart now: {:.1f} mm",
        state.separationM * 1000.0F));
}

}  // namespace

void drawJointFields(const PartFields& fields) {
    Editor& editor = fields.context.editor;
    const ConstraintProfile& constraint = fields.constraint();
    const auto bodies = editor.player().simulation().worldFromBody(fields.doll);
    const auto state = physics::measureConstraint(constraint, bodies[constraint.parent], bodies[constraint.child]);
    const auto& parent = editor.document().profile().bodies[constraint.parent];
    const char* words = "JOINT TO ";
    // Beside the button behind it.
    const float taken =
        ImGui::CalcTextSize(words).x + ImGui::CalcTextSize("Swing").x + 4.0F * ImGui::GetStyle().FramePadding.x;
    caption((words + nameWithin(parent.name, ImGui::GetContentRegionAvail().x - taken)).c_str());
    tooltip("The joint that hangs it on " + parent.name);
    swingButton(fields, state);
    kindField(fields);
    frictionField(fields);
    strengthField(fields);
    // Last, since a hinge has fewer lines: what stands above keeps its place.
    limitFields(fields, state);
}

}  // namespace lutka::editor
