/// Grab, Rotate and Scale. On a body, Grab pulls it through the physics, Rotate turns its whole doll, and Scale resizes
/// its shape; on an object of the scene all three edit the document, as one entry of undo. A character of another model
/// is such an object, but a drag on it pulls the body under the mouse. By its gizmo a body's shape is moved, turned and
/// resized in its joint instead.

#include <fmt/format.h>

#include <functional>

#include <glm/geometric.hpp>

#include "editor/states/states.hpp"
#include "editor/view/gizmo.hpp"

namespace lutka::editor {
namespace {

constexpr render::Color kPullColor{255, 196, 64, 255};
constexpr float kGuideLength = 50.0F;    // metres; an axis guide crosses the picture
constexpr float kDepthPerNotch = 0.06F;  // of the distance to the eye
constexpr const char* kTransformGroup = "transform";

/// What the three share: begun by a key or by a drag, ended by release, click, Enter, Esc or right click; the axis keys
/// and numbers.
class TransformHandler : public StateHandler {
  public:
    explicit TransformHandler(Workspace& workspace) : workspace_(workspace) {}

    void enter() override {
        byGizmo_ = workspace_.gizmoLock.has_value();
        lock_ = std::exchange(workspace_.gizmoLock, std::nullopt).value_or(AxisLock{});
        moved_ = false;
        number_.clear();
        confirmed_ = false;
        byDrag_ = workspace_.press.has_value();
        item_ = workspace_.selection.active();
        startMouse_ = byDrag_ ? workspace_.press->position : workspace_.mouse;
        if (!item_) return;
        pivot_ = workspace_.positionOf(*item_);
        own_ = workspace_.frameOf(*item_).rotation;
        if (item_->kind == Item::Kind::object) {
            before_ = workspace_.document->scene();
            // A character is moved by where it starts, anything else from where it is now.
            const bool character = before_.find<scene::Ragdoll>(entity()) != nullptr;
            world_ =
                character ? scene::worldFromEntity(before_, entity()) : workspace_.player->worldFromEntity(entity());
        }
        if (onBody()) {
            body_ = workspace_.document->profile().bodies[item_->index];
            worldFromJoint_ = workspace_.frameOf(*item_) * inverse(body_.jointFromBody);
        }
        begin();
        change();
    }

    void exit() override {
        if (item_) finish(confirmed_);
        workspace_.pulls.mouse.reset();
        workspace_.pulls.applyTo(workspace_.player->simulation());
        workspace_.document->endGroup();
        workspace_.press.reset();
        workspace_.hint.clear();
        item_.reset();
    }

    void update() override {
        if (item_ && !workspace_.selection.contains(*item_)) item_.reset();  // it is gone
        if (!item_) return;
        hold();
        workspace_.hint = describe();
        if (lock_.kind == AxisLock::Kind::axis) guide(lock_.axis);
        if (lock_.kind == AxisLock::Kind::plane) {
            for (int axis = 0; axis < 3; ++axis) {
                if (axis != lock_.axis) guide(axis);
            }
        }
    }

    std::optional<Trigger> mouseMove(const vec2& /*position*/, const vec2& /*movement*/) override {
        moved_ = true;
        if (item_) change();
        return std::nullopt;
    }

    std::optional<Trigger> mouseButton(const InputEvent& event) override {
        if (event.button == MouseButton::left && event.pressed != byDrag_) return end(true);
        if (event.button == MouseButton::right && event.pressed) return end(false);
        return std::nullopt;
    }

    std::optional<Trigger> key(const InputEvent& event) override {
        if (!event.pressed) return std::nullopt;
        if (event.key == Key::escape) return end(false);
        if (event.key == Key::enter) return end(true);
        if (event.key >= Key::x && event.key <= Key::z) {
            lock_ = pressAxis(lock_, static_cast<int>(event.key) - static_cast<int>(Key::x), event.modifiers.shift);
        } else if (!typeNumber(event.key)) {
            return otherKey(event.key);
        }
        moved_ = true;
        if (item_) change();
        return std::nullopt;
    }

  protected:
    virtual void begin() {}
    /// Something moved: takes over the mouse, the lock and the number.
    virtual void change() = 0;
    /// Once a frame: keeps up what physics would undo.
    virtual void hold() {}
    virtual void finish(bool confirmed) = 0;
    [[nodiscard]] virtual std::string describe() const = 0;
    virtual std::optional<Trigger> otherKey(Key key) {
        if (key == Key::g) return Trigger::grabKey;
        if (key == Key::r) return Trigger::rotateKey;
        if (key == Key::s) return Trigger::scaleKey;
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Trigger> end(bool confirmed) {
        confirmed_ = confirmed;
        return workspace_.ended();
    }
    [[nodiscard]] bool onBody() const { return item_->kind == Item::Kind::body; }
    /// Whether the shape is edited in its joint, and no doll pulled or turned.
    [[nodiscard]] bool onShape() const { return onBody() && byGizmo_; }
    /// The rotation of the axes that the lock means.
    [[nodiscard]] quat axes() const { return lock_.local ? own_ : quat(1, 0, 0, 0); }
    [[nodiscard]] vec3 axisOf(int axis) const { return axes() * axisVector(axis); }

    [[nodiscard]] scene::EntityId entity() const { return static_cast<scene::EntityId>(item_->index); }

    // The scene is as it was when the state began, but for what `change` does to it.
    void setEntity(const char* what, const std::function<void(scene::EntityScene&)>& change) {
        SceneSettings settings = workspace_.document->sceneDocument().settings();
        settings.entities = before_;
        change(settings.entities);
        const std::string label = fmt::format("{} {}", what, workspace_.nameOf(*item_));
        workspace_.report(workspace_.document->setScene(settings, label, kTransformGroup));
        workspace_.follow();
    }
    void placeEntity(const char* what, const RigidTransform& world) {
        setEntity(what, [&](scene::EntityScene& scene) { scene::placeEntity(scene, entity(), world); });
    }

    /// The body is as it was when the state began, but for what `change` does to it.
    void setBody(const char* what, const std::function<void(physics::BodyProfile&)>& change) {
        workspace_.edit([&](EditorDocument& document) {
            return document.changeParts(std::span(&item_->index, 1), what, kTransformGroup,
                                        [&](EditorDocument::Part& part) -> Result<void> {
                                            part.body.shape = body_.shape;
                                            part.body.jointFromBody = body_.jointFromBody;
                                            change(part.body);
                                            return {};
                                        });
        });
    }

    // What was not moved is no change.
    void keepOrCancelEdits(bool confirmed) {
        if (confirmed && moved_) return;
        workspace_.document->cancelGroup();
        workspace_.follow();
    }

    [[nodiscard]] std::string suffix() const {
        const std::string lock = lockText(lock_);
        return (number_.text().empty() ? "" : "  [" + number_.text() + "]") + (lock.empty() ? "" : "  " + lock) +
               (byDrag_ ? "   release: done  Esc: cancel" : "   click, Enter: done  Esc: cancel");
    }

    Workspace& workspace_;
    std::optional<Item> item_;
    scene::EntityScene before_;  // as it was
    RigidTransform world_;       // where the entity was
    physics::BodyProfile body_;  // as it was
    RigidTransform worldFromJoint_;
    quat own_{1, 0, 0, 0};  // the item's own axes
    vec3 pivot_{0, 0, 0};
    vec2 startMouse_{0, 0};
    AxisLock lock_;
    NumberEntry number_;
    bool byDrag_ = false;
    bool byGizmo_ = false;
    bool moved_ = false;  // since it began
    bool confirmed_ = false;

  private:
    bool typeNumber(Key key) {
        if (key >= Key::digit0 && key <= Key::digit9) {
            number_.type(static_cast<int>(key) - static_cast<int>(Key::digit0));
        } else if (key == Key::minus) {
            number_.type(NumberEntry::kMinus);
        } else if (key == Key::period) {
            number_.type(NumberEntry::kPoint);
        } else if (key == Key::backspace) {
            number_.backspace();
        } else {
            return false;
        }
        return true;
    }

    void guide(int axis) {
        const vec3 along = axisOf(axis) * kGuideLength;
        workspace_.overlay.add(pivot_ - along, pivot_ + along, axisColor(axis));
    }
};

class GrabHandler final : public TransformHandler {
  public:
    using TransformHandler::TransformHandler;

    std::optional<Trigger> wheel(float notches) override {
        depth_ += notches * kDepthPerNotch * glm::distance(render::eyeOf(workspace_.camera), start_);
        if (item_) change();
        return std::nullopt;
    }

  protected:
    void begin() override {
        depth_ = 0;
        // Dragged, the point under the mouse follows it; by a key what counts is how far the mouse has gone since.
        const bool dragged = byDrag_ && workspace_.press->pick;
        start_ = dragged ? workspace_.press->pick->position : pivot_;
        pulled_ = dragged ? workspace_.press->pick->body : std::nullopt;
        if (onBody() && !byGizmo_) pulled_ = item_;
        if (pulled_) startPull(dragged);
        grabbedAt_ = dragged ? start_ : mousePoint().value_or(start_);
        target_ = start_;
    }

    void change() override {
        if (const auto number = number_.value()) {
            target_ = start_ + axisOf(lock_.kind == AxisLock::Kind::axis ? lock_.axis : 0) * *number;
        } else if (const auto point = mousePoint()) {
            const bool toAxis = lock_.kind == AxisLock::Kind::axis && !byGizmo_;
            target_ = toAxis ? *point : start_ + (*point - grabbedAt_);
        }
        if (pulled_) {
            if (workspace_.pulls.mouse) workspace_.pulls.mouse->target = target_;
            return;
        }
        if (onShape()) {
            const vec3 moved = glm::conjugate(worldFromJoint_.rotation) * (target_ - start_);
            return setBody("Offset", [&](physics::BodyProfile& body) { body.jointFromBody.translation += moved; });
        }
        placeEntity("Move", {world_.rotation, world_.translation + target_ - start_});
    }

    void hold() override {
        if (!pulled_ || !workspace_.pulls.mouse) return;
        workspace_.pose(!workspace_.player->playing());
        const auto bodies = workspace_.player->bodiesOf(pulled_->doll);
        const vec3 held = bodies[pulled_->index].worldFromBody * workspace_.pulls.mouse->bodyPoint;
        workspace_.overlay.add(held, target_, kPullColor);
        render::addCross(workspace_.overlay, target_, 0.06F, kPullColor);
    }

    void finish(bool confirmed) override {
        if (!pulled_) return keepOrCancelEdits(confirmed);
        workspace_.pose(false);
        const auto before = std::exchange(posedFrom_, nullptr);
        const bool gone = pulled_->doll >= workspace_.player->simulation().dollCount();
        if (before == nullptr || gone || workspace_.player->moment() == before->moment) return;
        if (confirmed) {
            workspace_.document->moved(fmt::format("Pose {}", nameOfPulled()), before);
        } else {
            workspace_.restore(*before, true);
        }
    }

    std::optional<Trigger> otherKey(Key key) override {
        if (key != Key::p || !workspace_.pulls.mouse) return TransformHandler::otherKey(key);
        // In a paused scene the pose keeps the pin as well.
        if (posedFrom_ == nullptr)
            workspace_.document->moved(fmt::format("Pin {}", nameOfPulled()), workspace_.playState(), false);
        workspace_.pulls.pins.push_back(*workspace_.pulls.mouse);
        workspace_.say(Toast::Kind::info,
                       fmt::format("Pinned {}; P on it again lets go", workspace_.pulls.mouse->body));
        return end(true);
    }

    [[nodiscard]] std::string describe() const override {
        const vec3 d = target_ - start_;
        const char* paused = pulled_ && !workspace_.player->playing() ? "  posing" : "";
        return fmt::format("Grab {:+.2f} {:+.2f} {:+.2f} m{}{}{}", d.x, d.y, d.z, paused, suffix(),
                           pulled_ ? "  P: pin  wheel: depth" : "");
    }

  private:
    void startPull(bool dragged) {
        const RigidTransform worldFromBody = workspace_.player->bodiesOf(pulled_->doll)[pulled_->index].worldFromBody;
        Pull pull;
        pull.doll = pulled_->doll;
        pull.body = workspace_.player->simulation().assetOf(pulled_->doll).profile.bodies[pulled_->index].name;
        pull.bodyPoint = dragged ? workspace_.press->bodyPoint : vec3(0);
        start_ = worldFromBody * pull.bodyPoint;
        pull.target = start_;
        workspace_.pulls.mouse = pull;
        posedFrom_ = workspace_.player->playing() ? nullptr : workspace_.playState();
    }

    [[nodiscard]] std::string nameOfPulled() const {
        const physics::BodyProfile& body =
            workspace_.player->simulation().assetOf(pulled_->doll).profile.bodies[pulled_->index];
        return body.name;
    }

    [[nodiscard]] std::optional<vec3> mousePoint() const {
        return dragTarget(workspace_.mouseRay(), start_, render::forwardOf(workspace_.camera), lock_, depth_, axes());
    }

    std::optional<Item> pulled_;                  // the body that is held; else the entity is moved
    std::shared_ptr<const PlayState> posedFrom_;  // before a pose; null while the scene plays
    vec3 start_{0, 0, 0};
    vec3 grabbedAt_{0, 0, 0};
    vec3 target_{0, 0, 0};
    float depth_ = 0;
};

class RotateHandler final : public TransformHandler {
  public:
    using TransformHandler::TransformHandler;

  protected:
    void begin() override {
        angle_ = 0;
        startAngle_ = mouseAngle().value_or(0.0F);
        if (!onBody() || byGizmo_) return;
        turnedFrom_ = workspace_.playState();
        bodies_ = workspace_.player->bodiesOf(item_->doll);
        pivot_ = bodies_.front().worldFromBody.translation;
        startAngle_ = mouseAngle().value_or(0.0F);
    }

    void change() override {
        if (const auto number = number_.value()) {
            angle_ = radians(*number);
        } else if (const auto angle = mouseAngle()) {
            angle_ = std::remainder(*angle - startAngle_, 2.0F * kPi);
            // The mouse goes round as the eye sees it; seen from behind an axis that is the other way.
            if (lock_.kind != AxisLock::Kind::free && glm::dot(axis(), render::forwardOf(workspace_.camera)) > 0) {
                angle_ = -angle_;
            }
        }
        if (onShape()) {
            return setBody("Turn", [&](physics::BodyProfile& body) {
                const quat world = rotation() * worldFromJoint_.rotation * body.jointFromBody.rotation;
                body.jointFromBody.rotation = glm::normalize(glm::conjugate(worldFromJoint_.rotation) * world);
            });
        }
        if (onBody()) return;
        placeEntity("Rotate", {glm::normalize(rotation() * world_.rotation), world_.translation});
    }

    // While it is turned the doll keeps still, whatever gravity wants.
    void hold() override {
        if (onBody() && !byGizmo_) workspace_.player->placeBodies(item_->doll, turned(rotation()));
    }

    void finish(bool confirmed) override {
        if (!onBody() || byGizmo_) {
            keepOrCancelEdits(confirmed);
        } else if (item_->doll < workspace_.player->simulation().dollCount()) {
            workspace_.player->placeBodies(item_->doll, confirmed ? turned(rotation()) : bodies_);
            if (confirmed) workspace_.document->moved("Turn the doll", turnedFrom_);
        }
        turnedFrom_.reset();
    }

    [[nodiscard]] std::string describe() const override {
        return fmt::format("Rotate {:+.1f} deg{}", degrees(angle_), suffix());
    }

  private:
    [[nodiscard]] vec3 axis() const {
        return lock_.kind == AxisLock::Kind::free ? -render::forwardOf(workspace_.camera) : axisOf(lock_.axis);
    }
    [[nodiscard]] quat rotation() const { return glm::angleAxis(angle_, axis()); }

    // Counter-clockwise from the right, around where the pivot is seen.
    [[nodiscard]] std::optional<float> mouseAngle() const {
        const auto centre = render::project(workspace_.camera, pivot_, workspace_.window);
        if (!centre) return std::nullopt;
        return std::atan2(centre->y - workspace_.mouse.y, workspace_.mouse.x - centre->x);
    }

    [[nodiscard]] std::vector<physics::BodyState> turned(const quat& rotation) const {
        std::vector<physics::BodyState> bodies = bodies_;
        for (physics::BodyState& body : bodies) {
            RigidTransform& frame = body.worldFromBody;
            frame.translation = pivot_ + rotation * (frame.translation - pivot_);
            frame.rotation = glm::normalize(rotation * frame.rotation);
            body.linearVelocity = vec3(0);
            body.angularVelocity = vec3(0);
        }
        return bodies;
    }

    std::vector<physics::BodyState> bodies_;  // as they were
    std::shared_ptr<const PlayState> turnedFrom_;
    float startAngle_ = 0;
    float angle_ = 0;
};

class ScaleHandler final : public TransformHandler {
  public:
    using TransformHandler::TransformHandler;

  protected:
    void begin() override {
        factor_ = 1;
        startDistance_ = mouseDistance();
    }

    void change() override {
        constexpr float smallest = 0.05F;
        constexpr float largest = 20.0F;
        const float wanted = number_.value().value_or(mouseDistance() / std::max(startDistance_, 1.0F));
        factor_ = std::clamp(wanted, smallest, largest);
        if (onBody()) return setBody("Shape", [&](physics::BodyProfile& body) { scale(body.shape); });
        setEntity("Scale", [&](scene::EntityScene& scene) { scale(scene); });
    }

    void finish(bool confirmed) override { keepOrCancelEdits(confirmed); }

    [[nodiscard]] std::string describe() const override { return fmt::format("Scale x{:.3f}{}", factor_, suffix()); }

  private:
    [[nodiscard]] bool scales(int axis) const {
        const bool along = (axis == lock_.axis) == (lock_.kind == AxisLock::Kind::axis);
        return lock_.kind == AxisLock::Kind::free || along;
    }

    // The further shapes go with the main one: their places, and their measures where all axes are scaled.
    void scale(physics::BodyShape& shape) const {
        scaleMeasures(shape);
        for (physics::AddedShape& added : shape.more) {
            if (lock_.kind == AxisLock::Kind::free) scaleMeasures(added);
            for (int axis = 0; axis < 3; ++axis)
                if (scales(axis)) added.bodyFromShape.translation[axis] *= factor_;
        }
    }

    // A capsule's axis is its y.
    void scaleMeasures(physics::PrimitiveShape& shape) const {
        if (scales(0) || scales(2)) shape.radius *= factor_;
        if (scales(1)) shape.halfLength *= factor_;
        for (int axis = 0; axis < 3; ++axis) {
            if (scales(axis)) shape.halfExtents[axis] *= factor_;
        }
        if (shape.kind != physics::PrimitiveShape::Kind::hull) return;
        physics::scaleHull(shape, {scales(0) ? factor_ : 1.0F, scales(1) ? factor_ : 1.0F, scales(2) ? factor_ : 1.0F});
    }

    // A shape by its measures, a light by how strong it is, a camera by how far it sees.
    void scale(scene::EntityScene& scene) const {
        if (auto* collider = scene.find<scene::Collider>(entity())) {
            for (float* length : {&collider->radius, &collider->halfLength, &collider->width, &collider->length,
                                  &collider->rise, &collider->run}) {
                *length *= factor_;
            }
            for (int axis = 0; axis < 3; ++axis) {
                if (scales(axis)) collider->halfExtents[axis] *= factor_;
            }
        }
        if (auto* light = scene.find<scene::Light>(entity())) light->intensity *= factor_;
        if (auto* camera = scene.find<scene::Camera>(entity())) camera->distance *= factor_;
    }

    [[nodiscard]] float mouseDistance() const {
        const auto centre = render::project(workspace_.camera, pivot_, workspace_.window);
        return centre ? glm::distance(vec2(*centre), workspace_.mouse) : 1.0F;
    }

    float startDistance_ = 1;
    float factor_ = 1;
};

}  // namespace

std::unique_ptr<StateHandler> makeGrabHandler(Workspace& workspace) {
    return std::make_unique<GrabHandler>(workspace);
}

std::unique_ptr<StateHandler> makeRotateHandler(Workspace& workspace) {
    return std::make_unique<RotateHandler>(workspace);
}

std::unique_ptr<StateHandler> makeScaleHandler(Workspace& workspace) {
    return std::make_unique<ScaleHandler>(workspace);
}

}  // namespace lutka::editor
