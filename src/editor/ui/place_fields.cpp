/// The Body tab's rare fields: where the shape sits in its joint, and the constraint's axes.

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtx/euler_angles.hpp>

#include "editor/ui/part_fields.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

bool dragDegrees(const char* id, vec3& angles) {
    return ImGui::DragFloat3(id, &angles.x, 0.5F, -180.0F, 180.0F, "%.0f°");
}

void offsetField(const PartFields& fields) {
    const RigidTransform& now = fields.profile().jointFromBody;
    const RigidTransform& was = fields.fitted().jointFromBody;
    vec3 moved = (glm::conjugate(was.rotation) * (now.translation - was.translation)) * 100.0F;
    fieldRow(fields, "Offset");
    if (ImGui::DragFloat3("##offset", &moved.x, 0.1F, -100.0F, 100.0F, "%.1f")) {
        fields.change("Offset", [&](EditorDocument::Part& part) -> Result<void> {
            const RigidTransform& fitted = fields.fittedOf(part).jointFromBody;
            part.body.jointFromBody.translation = fitted * (moved * 0.01F);
            return {};
        });
    }
    tooltip("Where the shape is, in centimetres along its own axes from where the fit has it. Its joints stay.");
    if (wasText(fields, "offset", glm::length(moved) > 0.005F, "0 0 0")) {
        fields.change("Offset", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.jointFromBody.translation = fields.fittedOf(part).jointFromBody.translation;
            return {};
        });
    }
}

void turnField(const PartFields& fields) {
    const RigidTransform& now = fields.profile().jointFromBody;
    const RigidTransform& was = fields.fitted().jointFromBody;
    vec3 turned = degreesOf(glm::conjugate(was.rotation) * now.rotation);
    fieldRow(fields, "Turned");
    if (dragDegrees("##turned", turned)) {
        fields.change("Turn", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.jointFromBody.rotation =
                glm::normalize(fields.fittedOf(part).jointFromBody.rotation * rotationFromDegrees(turned));
            return {};
        });
    }
    tooltip("How the shape is turned about its own axes from where the fit has it");
    if (wasText(fields, "turned", glm::length(turned) > 0.05F, "0 0 0")) {
        fields.change("Turn", [&](EditorDocument::Part& part) -> Result<void> {
            part.body.jointFromBody.rotation = fields.fittedOf(part).jointFromBody.rotation;
            return {};
        });
    }
}

// Turns the axes of all parts by the same turn; on the other side of the body by its mirror image.
void turnAxes(const PartFields& fields, const quat& turn) {
    fields.change("Axes", [&](EditorDocument::Part& part) -> Result<void> {
        if (part.constraint == nullptr) return {};
        const quat own = fields.across(part) ? physics::mirrored(physics::FrameEdit{turn, {}}).turn : turn;
        physics::turnFrames(*part.constraint, own);
        return {};
    });
}

void axesField(const PartFields& fields) {
    const quat present = fields.edits().frames ? fields.edits().frames->turn : quat(1, 0, 0, 0);
    vec3 turned = degreesOf(present);
    fieldRow(fields, "Axes");
    if (dragDegrees("##axes", turned)) turnAxes(fields, glm::conjugate(present) * rotationFromDegrees(turned));
    tooltip(
        "How the joint's axes are turned from the fitted ones: x twist, y side, z flexion. The neutral pose stays.");
    if (wasText(fields, "axes", glm::length(turned) > 0.05F, "0 0 0")) turnAxes(fields, glm::conjugate(present));
    fieldRow(fields, "");
    constexpr std::pair<const char*, vec3> steps[] = {{"x 90", {1, 0, 0}}, {"y 90", {0, 1, 0}}, {"z 90", {0, 0, 1}}};
    for (const auto& [name, axis] : steps) {
        if (ImGui::SmallButton(name)) turnAxes(fields, glm::angleAxis(radians(90.0F), axis));
        tooltip("Turns the axes by a quarter about this one");
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

}  // namespace

vec3 degreesOf(const quat& rotation) {
    vec3 angles(0);
    glm::extractEulerAngleXYZ(glm::mat4_cast(rotation), angles.x, angles.y, angles.z);
    // Rounding may leave a hair below 0, which would be shown as -0.
    const auto shown = [](float radiansOf) {
        const float value = degrees(radiansOf);
        return std::abs(value) < 0.05F ? 0.0F : value;
    };
    return {shown(angles.x), shown(angles.y), shown(angles.z)};
}

quat rotationFromDegrees(const vec3& angles) {
    return glm::normalize(glm::quat_cast(glm::eulerAngleXYZ(radians(angles.x), radians(angles.y), radians(angles.z))));
}

void drawPlaceFields(const PartFields& fields) {
    const bool edited = fields.edits().jointFromBody || fields.edits().frames;
    ImGui::SetNextItemOpen(edited, ImGuiCond_Once);
    if (!ImGui::TreeNodeEx("Place and axes", ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen)) {
        return;
    }
    offsetField(fields);
    turnField(fields);
    if (fields.body() > 0) axesField(fields);
}

}  // namespace lutka::editor
