#include "editor/states/body_commands.hpp"

#include <fmt/format.h>

#include "physics/fit/edit_bodies.hpp"

namespace lutka::editor {

using physics::RagdollProfile;

void BodyCommands::copy() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (bodies.empty()) return;
    workspace_.clipboard = workspace_.document->copyPart(bodies.back());
    workspace_.say(Toast::Kind::info,
                   fmt::format("Copied {}", workspace_.document->profile().bodies[bodies.back()].name));
}

void BodyCommands::paste() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (!workspace_.clipboard || bodies.empty()) return;
    workspace_.edit([&](EditorDocument& one) { return one.pasteParts(bodies, *workspace_.clipboard); });
}

void BodyCommands::mirror() {
    const std::vector<int> bodies = workspace_.selectedBodies();
    if (!bodies.empty()) workspace_.edit([&](EditorDocument& one) { return one.mirrorParts(bodies); });
}

void BodyCommands::add(int joint) {
    const animation::Character& character = workspace_.document->character();
    const std::string& name = character.skeleton.names[joint];
    const bool done = workspace_.edit([&](EditorDocument& document) {
        return document.changeBodies(fmt::format("Add a body on {}", name), [&](const RagdollProfile& profile) {
            return physics::addBody(profile, character, document.state().map, joint);
        });
    });
    const int body = physics::bodyCarryingJoint(workspace_.document->profile(), character.skeleton, joint);
    if (done) workspace_.selection.set({Item::Kind::body, 0, body});
}

std::vector<std::string> BodyCommands::selectedNames() const {
    std::vector<std::string> names;
    for (const int body : workspace_.selectedBodies())
        names.push_back(workspace_.document->profile().bodies[body].name);
    return names;
}

bool BodyCommands::changeEach(const char* what, const Change& change) {
    const std::vector<std::string> names = selectedNames();
    if (names.empty()) return false;
    const std::string of = names.size() == 1 ? names.front() : fmt::format("{} bodies", names.size());
    return workspace_.edit([&](EditorDocument& document) {
        return document.changeBodies(fmt::format("{} {}", what, of),
                                     [&](const RagdollProfile& profile) -> Result<RagdollProfile> {
                                         RagdollProfile work = profile;
                                         for (const std::string& name : names) {
                                             const int body = physics::bodyNamed(work, name);
                                             if (body < 0) continue;
                                             auto changed = change(work, body);
                                             if (!changed) return changed;
                                             work = std::move(changed).value();
                                         }
                                         return work;
                                     });
    });
}

void BodyCommands::remove() {
    changeEach("Remove", [&](const RagdollProfile& profile, int body) {
        return physics::removeBody(profile, workspace_.document->character(), body);
    });
}

void BodyCommands::merge() {
    changeEach("Merge", [&](const RagdollProfile& profile, int body) {
        return physics::mergeBody(profile, workspace_.document->character(), workspace_.document->state().map, body);
    });
}

void BodyCommands::split() {
    changeEach("Split", [&](const RagdollProfile& profile, int body) {
        return physics::splitBody(profile, workspace_.document->character(), workspace_.document->state().map, body);
    });
}

void BodyCommands::beginByHand() {
    workspace_.edit([&](EditorDocument& document) {
        return document.changeBodies("Begin by hand", [&](const RagdollProfile& profile) -> Result<RagdollProfile> {
            return physics::rootAlone(profile, document.character(), document.state().map);
        });
    });
    workspace_.document->beginHere();  // the one body is no work of the user's that could be lost
    workspace_.say(Toast::Kind::info,
                   "One body for all: add others by a right click on a joint of the tree, or Ctrl+B");
}

void BodyCommands::toggleSymmetric() {
    EditorDocument& document = *workspace_.document;
    document.setSymmetric(!document.symmetric());
    workspace_.say(Toast::Kind::info, document.symmetric() ? "Changes of a body go to the other side as well"
                                                           : "Each side is changed by itself");
}

}  // namespace lutka::editor
