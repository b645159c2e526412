/// The inspector: every parameter of every component of the selected entity, as edits with undo.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

#include "animation/clip_reference.hpp"
#include "editor/ui/clip_list.hpp"
#include "editor/ui/panels.hpp"
#include "editor/ui/style.hpp"
#include "editor/ui/widgets.hpp"

namespace lutka::editor {
namespace {

using scene::EntityId;
using scene::EntityScene;

constexpr float kFine = 0.01F;  // of a drag, a pixel

/// Widgets for the fields of one component: they change a copy, and whether any did is what the edit hangs on.
class Fields {
  public:
    explicit Fields(const PanelContext& context) : width_(context.px(96)) {}

    void number(const char* label, float& value, float low, float high, const char* format, float speed = kFine) {
        labelled(label, width_);
        if (ImGui::DragFloat(id(label), &value, speed, low, high, format)) change(label);
    }
    void angle(const char* label, float& value, float lowDeg, float highDeg) {
        float shown = degrees(value);
        labelled(label, width_);
        if (!ImGui::DragFloat(id(label), &shown, 0.25F, lowDeg, highDeg, "%.1f°")) return;
        value = radians(std::clamp(shown, lowDeg, highDeg));
        change(label);
    }
    void whole(const char* label, int& value, int low, int high) {
        labelled(label, width_);
        if (ImGui::DragInt(id(label), &value, 0.1F, low, high)) change(label);
    }
    void vector(const char* label, vec3& value, float low, float high, const char* format, float speed = kFine) {
        labelled(label, width_);
        if (ImGui::DragFloat3(id(label), &value.x, speed, low, high, format)) change(label);
    }
    void flag(const char* label, bool& value) {
        if (ImGui::Checkbox(label, &value)) change(label);
    }
    void choice(const char* label, int& value, const char* choices) {
        labelled(label, width_);
        if (ImGui::Combo(id(label), &value, choices)) change(label);
    }
    template <class Enum>
    void choice(const char* label, Enum& value, const char* choices) {
        int index = static_cast<int>(value);
        choice(label, index, choices);
        value = static_cast<Enum>(index);
    }
    void color(const char* label, vec3& value) {
        labelled(label, width_);
        if (ImGui::ColorEdit3(id(label), &value.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs)) {
            change(label);
        }
    }
    void color(const char* label, render::Color& value) {
        constexpr float whole = 255.0F;
        vec3 shown = vec3(value.r, value.g, value.b) / whole;
        labelled(label, width_);
        if (!ImGui::ColorEdit3(id(label), &shown.x, ImGuiColorEditFlags_NoInputs)) return;
        const auto channel = [](float part) { return static_cast<std::uint8_t>(std::lround(part * whole)); };
        value = {channel(shown.r), channel(shown.g), channel(shown.b), 255};
        change(label);
    }
    /// A path that counts at Enter or when it is left; whether the user wants to choose it in a dialog. `empty` says
    /// what no path means.
    bool path(const char* label, std::filesystem::path& value, const char* empty) {
        labelled(label, width_);
        std::string text = value.string();
        bool browse = false;
        if (pathLine(id(label), text, browse)) {
            value = text;
            change(label);
        }
        if (text.empty()) tooltip(std::string("None: ") + empty);
        return browse;
    }

    void change(const char* what) { changed_ = what; }
    /// What was changed; null: nothing.
    [[nodiscard]] const char* changed() const { return changed_; }
    [[nodiscard]] float labelWidth() const { return width_; }

  private:
    const char* id(const char* label) {
        id_ = std::string("##") + label;
        return id_.c_str();
    }

    float width_;
    std::string id_;
    const char* changed_ = nullptr;
};

// Degrees about Y, then X, then Z, as editors show a rotation.
vec3 eulerDegOf(const quat& rotation) {
    const mat3 m = glm::mat3_cast(rotation);
    const float x = std::asin(std::clamp(-m[2][1], -1.0F, 1.0F));
    const float y = std::atan2(m[2][0], m[2][2]);
    const float z = std::atan2(m[0][1], m[1][1]);
    return vec3(degrees(x), degrees(y), degrees(z)) + 0.0F;  // no -0
}

quat fromEulerDeg(const vec3& angles) {
    return glm::normalize(glm::angleAxis(radians(angles.y), vec3(0, 1, 0)) *
                          glm::angleAxis(radians(angles.x), vec3(1, 0, 0)) *
                          glm::angleAxis(radians(angles.z), vec3(0, 0, 1)));
}

void draw(const PanelContext& context, Fields& fields, scene::Transform& transform) {
    RigidTransform& frame = transform.parentFromEntity;
    fields.vector("Position", frame.translation, -1000, 1000, "%.2f m");
    // While it is dragged the angles stay those on show: others may mean the same rotation.
    UiState::ShownAngles& shown = context.state.angles;
    if (shown.entity != transform.entity || shown.rotation != frame.rotation) {
        shown = {transform.entity, frame.rotation, eulerDegOf(frame.rotation)};
    }
    const vec3 before = shown.degrees;
    fields.vector("Rotation", shown.degrees, -360, 360, "%.1f°", 0.5F);
    if (shown.degrees == before) return;
    frame.rotation = fromEulerDeg(shown.degrees);
    shown.rotation = frame.rotation;
}

void draw(const PanelContext& /*context*/, Fields& fields, scene::MeshRenderer& mesh) {
    fields.color("Colour", mesh.color);
    fields.number("Opacity", mesh.opacity, 0, 1, "%.2f", 0.005F);
    fields.flag("Visible", mesh.visible);
    ImGui::SameLine();
    fields.flag("Casts a shadow", mesh.castsShadow);
}

void draw(const PanelContext& /*context*/, Fields& fields, scene::RigidBody& body) {
    fields.number("Mass", body.massKg, 0.001F, 1e5F, "%.2f kg", 0.05F);
    fields.vector("Velocity", body.linearVelocity, -100, 100, "%.1f m/s", 0.05F);
    fields.vector("Spin", body.angularVelocity, -100, 100, "%.1f rad/s", 0.05F);
}

void draw(const PanelContext& /*context*/, Fields& fields, scene::Collider& collider) {
    using Kind = scene::Collider::Kind;
    constexpr float small = 0.01F;
    constexpr float large = 1000.0F;
    fields.choice("Shape", collider.kind, "Plane\0Box\0Sphere\0Capsule\0Ramp\0Stairs\0");
    if (collider.kind == Kind::box) fields.vector("Half size", collider.halfExtents, small, large, "%.2f m");
    if (collider.kind == Kind::sphere || collider.kind == Kind::capsule) {
        fields.number("Radius", collider.radius, small, large, "%.3f m");
    }
    if (collider.kind == Kind::capsule) fields.number("Half length", collider.halfLength, 0, large, "%.3f m");
    if (collider.kind == Kind::ramp || collider.kind == Kind::stairs) {
        fields.number("Width", collider.width, small, large, "%.2f m");
    }
    if (collider.kind == Kind::ramp) {
        fields.number("Length", collider.length, small, large, "%.2f m");
        fields.angle("Angle", collider.angle, 0, 88);
    }
    if (collider.kind == Kind::stairs) {
        fields.whole("Steps", collider.steps, 1, 200);
        fields.number("Rise", collider.rise, small, 10, "%.3f m");
        fields.number("Run", collider.run, small, 10, "%.3f m");
        fields.number("Landing", collider.length, 0, large, "%.2f m");
    }
    fields.number("Friction", collider.friction, 0, 10, "%.2f");
}

void drawClip(const PanelContext& context, Fields& fields, scene::Ragdoll& ragdoll) {
    const auto& clips = context.editor.document().sceneDocument().assetOf(ragdoll).character.clips;
    labelled("Clip", fields.labelWidth());
    const std::string shown = ragdoll.clip ? shownClip(clips, ragdoll.clip->clip) : "none";
    if (beginClipCombo("##clip", shown)) {
        if (ImGui::Selectable("none", !ragdoll.clip)) {
            ragdoll.clip.reset();
            fields.change("Clip");
        }
        if (const auto chosen = chooseListedClip(clips, ragdoll.clip ? ragdoll.clip->clip : "")) {
            ragdoll.clip = scene::ClipStart{*chosen, 0.0F};
            fields.change("Clip");
        }
        ImGui::EndCombo();
    }
    if (!ragdoll.clip) return;
    const int clip = animation::clipMeant(clips, ragdoll.clip->clip);
    fields.number("At", ragdoll.clip->seconds, 0, clip >= 0 ? clips[clip].seconds() : 60.0F, "%.2f s");
}

void drawPins(const PanelContext& context, Fields& fields, scene::Ragdoll& ragdoll) {
    std::string names;
    for (const std::string& name : ragdoll.pins)
        names += (names.empty() ? "" : ", ") + name;
    labelled("Held by", fields.labelWidth());
    if (!ImGui::BeginCombo("##pins", names.empty() ? "nothing" : names.c_str())) return;
    for (const auto& body : context.editor.document().sceneDocument().assetOf(ragdoll).profile.bodies) {
        bool held = std::find(ragdoll.pins.begin(), ragdoll.pins.end(), body.name) != ragdoll.pins.end();
        if (!ImGui::Checkbox(body.name.c_str(), &held)) continue;
        held ? ragdoll.pins.push_back(body.name) : static_cast<void>(std::erase(ragdoll.pins, body.name));
        fields.change("Pins");
    }
    ImGui::EndCombo();
}

void draw(const PanelContext& context, Fields& fields, scene::Ragdoll& ragdoll) {
    Editor& editor = context.editor;
    const auto browse = [&](Editor::Dialog dialog) {
        context.state.browsing = ragdoll.entity;
        editor.dialog = dialog;
    };
    if (fields.path("Model", ragdoll.model, "the character that is being edited")) browse(Editor::Dialog::chooseModel);
    int rig = ragdoll.rig ? 1 + static_cast<int>(*ragdoll.rig) : 0;
    fields.choice("Taken as", rig, "As the scene is opened\0A humanoid\0Any skeleton\0");
    if (rig == 0) {
        ragdoll.rig.reset();
    } else {
        ragdoll.rig = static_cast<physics::RigKind>(rig - 1);
    }
    tooltip("Any skeleton: bodies from the joints and the skin alone, for animals, hands and chains");
    if (fields.path("Profile", ragdoll.profile, "fitted, or the one that is being edited"))
        browse(Editor::Dialog::chooseProfile);
    int pose = ragdoll.pose ? 1 + static_cast<int>(*ragdoll.pose) : 0;
    fields.choice("Pose", pose, "As the simulation\0Bind pose\0File's node pose\0");
    if (pose == 0) {
        ragdoll.pose.reset();
    } else {
        ragdoll.pose = static_cast<scene::StartPose>(pose - 1);
    }
    drawClip(context, fields, ragdoll);
    drawPins(context, fields, ragdoll);
    fields.vector("Velocity", ragdoll.linearVelocity, -100, 100, "%.1f m/s", 0.05F);
    fields.vector("Spin", ragdoll.angularVelocity, -100, 100, "%.1f rad/s", 0.05F);
    if (editor.document().sceneDocument().isEdited(ragdoll)) {
        mutedText("This is the character that the other panels edit.");
    } else if (ImGui::Button("Edit this character")) {
        editor.editCharacter(ragdoll.entity);
    }
}

void draw(const PanelContext& /*context*/, Fields& fields, scene::Light& light) {
    using Kind = scene::Light::Kind;
    fields.choice("Kind", light.kind, "Sun\0Point\0Spot\0");
    fields.color("Colour", light.color);
    fields.number("Intensity", light.intensity, 0, 1000, "%.2f", 0.02F);
    if (light.kind == Kind::sun) {
        fields.angle("Disc", light.angularRadius, 0, 11);
        tooltip("Wider: softer shadows");
        fields.flag("Casts a shadow", light.castsShadow);
        return;
    }
    fields.number("Range", light.range, 0.1F, 1000, "%.1f m", 0.05F);
    if (light.kind != Kind::spot) return;
    fields.angle("Cone", light.outerAngle, 1, 90);
    light.innerAngle = std::min(light.innerAngle, light.outerAngle);
    fields.angle("Full within", light.innerAngle, 0, degrees(light.outerAngle));
    light.innerAngle = std::min(light.innerAngle, light.outerAngle);
}

void draw(const PanelContext& context, Fields& fields, scene::Camera& camera) {
    Editor& editor = context.editor;
    fields.angle("Lens", camera.fieldOfView, 5, 120);
    fields.number("Distance", camera.distance, 0.05F, 1000, "%.2f m");
    fields.flag("Parallel", camera.orthographic);
    ImGui::SameLine();
    fields.flag("Active", camera.active);
    tooltip("The first active camera gives pictures their view");
    if (ImGui::Button("Look through it")) editor.lookThrough(camera.entity);
    ImGui::SameLine();
    if (ImGui::Button("Place it at the view")) editor.placeCamera(camera.entity);
}

/// One component: its header, which removes it, and its fields.
template <class T>
void drawComponent(const PanelContext& context, EntityId id, const char* name) {
    const T* component = context.editor.document().scene().find<T>(id);
    if (component == nullptr) return;
    ImGui::PushID(static_cast<int>(id));
    ImGui::PushID(name);
    bool kept = true;
    const bool open = ImGui::CollapsingHeader(name, std::is_same_v<T, scene::Transform> ? nullptr : &kept,
                                              ImGuiTreeNodeFlags_DefaultOpen);
    if (!kept) {
        context.editor.editScene(fmt::format("Remove {}", name), "", [&](EntityScene& scene) { scene.remove<T>(id); });
    } else if (open) {
        T copy = *component;
        Fields fields(context);
        draw(context, fields, copy);
        if (const char* what = fields.changed()) {
            const std::string label = fmt::format("{}: {}", name, what);
            context.editor.editScene(label, fmt::format("{}.{}.{}", id, name, what),
                                     [&](EntityScene& scene) { scene.add(id, std::move(copy)); });
        }
    }
    ImGui::PopID();
    ImGui::PopID();
}

template <class T>
void offer(const PanelContext& context, EntityId id, const char* name, const T& component) {
    if (context.editor.document().scene().find<T>(id) != nullptr) return;
    if (!ImGui::MenuItem(name)) return;
    context.editor.editScene(fmt::format("Add {}", name), "", [&](EntityScene& scene) { scene.add(id, component); });
}

void drawAddComponent(const PanelContext& context, EntityId id) {
    if (ImGui::Button("+ Add component", {-1.0F, 0})) ImGui::OpenPopup("##addComponent");
    if (!ImGui::BeginPopup("##addComponent")) return;
    offer(context, id, "Transform", scene::Transform{});
    offer(context, id, "MeshRenderer", scene::MeshRenderer{});
    offer(context, id, "Collider", scene::Collider{});
    offer(context, id, "RigidBody", scene::RigidBody{});
    offer(context, id, "Ragdoll", scene::Ragdoll{});
    offer(context, id, "Light", scene::Light{});
    offer(context, id, "Camera", scene::Camera{});
    ImGui::EndPopup();
}

}  // namespace

void drawInspector(const PanelContext& context) {
    Editor& editor = context.editor;
    const auto active = editor.workspace().selection.active();
    if (!active || active->kind != Item::Kind::object) {
        mutedText(
            "Select an entity to see its components. A right click on one renames, duplicates or deletes it; "
            "dragging it onto another one hangs it there.");
        return;
    }
    const auto id = static_cast<EntityId>(active->index);
    const scene::Entity* entity = scene::findEntity(editor.document().scene(), id);
    if (entity == nullptr) return;
    const std::string title = entity->parent == scene::kNoEntity
                                  ? entity->name
                                  : fmt::format("{}  (on {})", entity->name,
                                                scene::findEntity(editor.document().scene(), entity->parent)->name);
    ImGui::TextColored(accentColor(), "%s", title.c_str());
    drawComponent<scene::Transform>(context, id, "Transform");
    drawComponent<scene::MeshRenderer>(context, id, "MeshRenderer");
    drawComponent<scene::Collider>(context, id, "Collider");
    drawComponent<scene::RigidBody>(context, id, "RigidBody");
    drawComponent<scene::Ragdoll>(context, id, "Ragdoll");
    drawComponent<scene::Light>(context, id, "Light");
    drawComponent<scene::Camera>(context, id, "Camera");
    drawAddComponent(context, id);
}

}  // namespace lutka::editor
