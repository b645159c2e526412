#pragma once

#include <string>
#include <vector>

#include "editor/ui/panels.hpp"

/// What the fields of the Body tab share: rows with the value that was fitted at their right, and edits of all
/// selected bodies at once.
namespace lutka::editor {

/// The bodies that the fields edit; the active one, which they show, is the last.
struct PartFields {
    const PanelContext& context;
    std::vector<int> bodies;
    int doll = 0;

    [[nodiscard]] int body() const { return bodies.back(); }
    [[nodiscard]] const physics::BodyProfile& profile() const;
    /// The same as fitted (or as the opened file has it).
    [[nodiscard]] const physics::BodyProfile& fitted() const;
    [[nodiscard]] const PartEdits& edits() const;
    /// The active body's constraint, as it is and as fitted; not for the root.
    [[nodiscard]] const physics::ConstraintProfile& constraint() const;
    [[nodiscard]] const physics::ConstraintProfile& fittedConstraint() const;
    [[nodiscard]] physics::BindFrames bind() const;
    [[nodiscard]] physics::BindFrames fittedBind() const;

    /// Of every row: what labels take, and the field behind them.
    [[nodiscard]] float labelWidth() const;
    [[nodiscard]] float fieldWidth() const;

    /// Changes all of them; `what` names it in undo, a drag of the field is one entry.
    void change(const std::string& what, const std::function<Result<void>(EditorDocument::Part&)>& change) const;
    /// Whether a part lies across the figure from the active one.
    [[nodiscard]] bool across(const EditorDocument::Part& part) const;
    /// The body in the fitted ragdoll that a part is of.
    [[nodiscard]] const physics::BodyProfile& fittedOf(const EditorDocument::Part& part) const;
    [[nodiscard]] const physics::ConstraintProfile* fittedConstraintOf(const EditorDocument::Part& part) const;
};

/// Begins a row: a label, room for a field (the next item), and room for wasText().
void fieldRow(const PartFields& fields, const char* label);
/// Ends the row: what the value was, if it was another; whether a click on it takes the change back.
[[nodiscard]] bool wasText(const PartFields& fields, const char* id, bool changed, const std::string& was);

/// A rotation as turns about x, then y, then z of the turned axes, in degrees, and back.
[[nodiscard]] vec3 degreesOf(const quat& rotation);
[[nodiscard]] quat rotationFromDegrees(const vec3& angles);

/// Sections of the tab.
void drawShapeFields(const PartFields& fields);

/// Makes a body the convex hull of its skin, in its place. Fails with ErrorCode::usage where it has none.
[[nodiscard]] Result<void> takeHullOfSkin(const PartFields& fields, EditorDocument::Part& part);
void drawPlaceFields(const PartFields& fields);
void drawAddedShapeFields(const PartFields& fields);
void drawJointFields(const PartFields& fields);

}  // namespace lutka::editor
