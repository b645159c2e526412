#include "editor/play/motion_commands.hpp"

#include <algorithm>

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
