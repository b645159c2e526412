#include "editor/play/motion_commands.hpp"

#include <algorithm>
#include <utility>

#include "animation/clip_reference.hpp"

namespace lutka::editor {
namespace {

constexpr float kThrowSpeed = 9.0F;  // m/s

}  // namespace

void MotionCommands::listen() {
    workspace_.document->follow([this] { return workspace_.playState(); });
}

void MotionCommands::reset() {
    workspace_.document->moved("Reset", workspace_.playState());
    restart();
}

void MotionCommands::restart() {
    workspace_.pulls.pins.clear();
    workspace_.report(workspace_.player->reset());
}

void MotionCommands::returnToPlay() {
    Player& player = *workspace_.player;
    if (player.canReturnToPlay()) {
        workspace_.document->moved("Back to where Play was pressed", workspace_.playState());
    }
    player.returnToPlay();
    workspace_.pulls.applyTo(player.simulation());
}

void MotionCommands::throwBall() {
    const render::Ray ray = workspace_.mouseRay();
    const vec3 from = ray.origin + ray.direction * std::min(0.5F, workspace_.camera.distance * 0.2F);
    const auto before = workspace_.playState();
    // Lifted a little, so that it meets what the mouse points at in spite of gravity.
    const vec3 velocity = ray.direction * kThrowSpeed + vec3(0, 0.8F, 0);
    if (workspace_.report(workspace_.player->throwBall(from, velocity))) return;
    workspace_.document->moved("Throw a ball", before);
    workspace_.pulls.applyTo(workspace_.player->simulation());
}

void MotionCommands::stepOnce() {
    workspace_.pulls.applyTo(workspace_.player->simulation());
    workspace_.player->stepOnce();
}

// The edited character's: the selected one, or the first.
int MotionCommands::activeDoll() const {
    const Player& player = *workspace_.player;
    if (player.clip() != nullptr) return player.clip()->doll();
    const auto active = workspace_.selection.active();
    if (active && active->kind == Item::Kind::body) return active->doll;
    int doll = 0;
    while (doll < player.simulation().dollCount() && !player.isEditedDoll(doll))
        ++doll;
    return doll < player.simulation().dollCount() ? doll : -1;
}

void MotionCommands::swingLimits() {
    endSwing();
    const auto active = workspace_.selection.active();
    if (!active || active->kind != Item::Kind::body || active->index == 0) return;
    std::vector<RigidTransform> bodies;
    for (const physics::BodyState& body : workspace_.player->bodiesOf(active->doll))
        bodies.push_back(body.worldFromBody);
    swing_.emplace(workspace_.document->profile(), active->index, std::move(bodies));
    swingDoll_ = active->doll;
}

void MotionCommands::endSwing() {
    if (!swing_) return;
    swing_.reset();
    workspace_.player->endPreview();
}

bool MotionCommands::advanceSwing(double seconds) {
    if (!swing_) return false;
    swing_->advance(static_cast<float>(seconds));
    workspace_.player->preview(swingDoll_, swing_->worldFromBody());
    workspace_.hint = "Within its limits: " + swing_->text() + "   Esc: stop";
    if (swing_->done()) endSwing();
    return true;
}

void MotionCommands::toggleClips(bool& shown) {
    shown = !shown;
    if (!shown) {
        workspace_.player->endClip(true);
        return;
    }
    const auto& clips = workspace_.document->character().clips;
    if (!clips.empty()) showClip(animation::clipReference(clips, 0));
}

void MotionCommands::showClip(const std::string& clip) {
    const int doll = activeDoll();
    if (doll < 0) return workspace_.say(Toast::Kind::info, "No character of the scene has these clips");
    if (workspace_.player->clip() == nullptr) beforeClip_ = workspace_.playState();
    workspace_.report(workspace_.player->showClip(clip, doll));
}

void MotionCommands::fallFromClip() {
    if (workspace_.player->clip() == nullptr) return;
    workspace_.player->endClip(false);
    if (beforeClip_ != nullptr) workspace_.document->moved("Fall from the clip", std::exchange(beforeClip_, nullptr));
}

scene::ScenePuppets MotionCommands::gettingUp() const {
    auto puppets = workspace_.document->scene().simulation.puppets.value_or(scene::ScenePuppets{});
    if (const ClipStage* clip = workspace_.player->clip()) puppets.clip = clip->clip();
    puppets.getUp = true;
    return puppets;
}

scene::ScenePuppets MotionCommands::firstMuscles() const {
    const bool begun = workspace_.player->seconds() > 0.0;
    const bool canRise = physics::bodyOf(workspace_.document->profile(), animation::Role::hips) >= 0;
    return begun && canRise ? gettingUp() : scene::ScenePuppets{};
}

void MotionCommands::hit(const Pick& pick) {
    if (workspace_.player->deck().replaying())
        return workspace_.say(Toast::Kind::info, "A take is shown: end the replay first");
    // What was clicked may be gone by another event of the same frame.
    const scene::Simulation& simulation = workspace_.player->simulation();
    const Item& item = *pick.body;
    if (item.doll >= simulation.dollCount() ||
        item.index >= static_cast<int>(simulation.assetOf(item.doll).profile.bodies.size()))
        return;
    const auto before = workspace_.playState();
    const vec3 impulse = workspace_.mouseRay().direction * workspace_.hitNs;
    workspace_.player->hit(*pick.body, pick.position, impulse);
    const auto& bodies = workspace_.player->simulation().assetOf(pick.body->doll).profile.bodies;
    const std::string& name = bodies[static_cast<std::size_t>(pick.body->index)].name;
    workspace_.document->moved("Hit " + name, before);
    if (!workspace_.player->playing())
        workspace_.say(Toast::Kind::info, "Hit " + name + ": it shows when the scene plays");
}

void MotionCommands::toggleSelectedOnly() {
    Player& player = *workspace_.player;
    if (player.held().any()) return player.simulateAll();
    std::vector<Item> bodies = workspace_.selection.items();
    std::erase_if(bodies, [](const Item& item) { return item.kind != Item::Kind::body; });
    if (bodies.empty())
        return workspace_.say(Toast::Kind::info, "Select the bodies that shall move; all others are held");
    player.simulateOnly(bodies);
}

void MotionCommands::travel(int changes) {
    EditorDocument::Step last;
    bool moves = false;
    for (; changes != 0; changes += changes < 0 ? 1 : -1) {
        last = changes < 0 ? workspace_.document->undo() : workspace_.document->redo();
        moves = moves || last.moves;
    }
    workspace_.follow();
    if (last.play != nullptr) workspace_.restore(*last.play, moves);
}

}  // namespace lutka::editor
