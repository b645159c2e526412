#include "editor/play/pin_commands.hpp"

#include <fmt/format.h>

namespace lutka::editor {

void PinCommands::toggle() {
    const auto active = workspace_.selection.active();
    if (!active) return;
    Pulls& pulls = workspace_.pulls;
    if (active->kind == Item::Kind::object) {
        const int doll = workspace_.player->dollOf(static_cast<scene::EntityId>(active->index));
        if (doll < 0) return;
        change("Let go of " + workspace_.nameOf(*active), [&](std::vector<Pull>& pins) {
            std::erase_if(pins, [&](const Pull& pin) { return pin.doll == doll; });
        });
        return;
    }
    const std::string name = workspace_.document->profile().bodies[active->index].name;
    if (pulls.findPin(active->doll, name) != pulls.pins.end()) {
        change(fmt::format("Let go of {}", name),
               [&](std::vector<Pull>& pins) { pins.erase(pulls.findPin(active->doll, name)); });
        return;
    }
    change(fmt::format("Pin {}", name), [&](std::vector<Pull>& pins) {
        pins.push_back({active->doll, name, vec3(0), workspace_.positionOf(*active)});
    });
}

void PinCommands::letAllGo() {
    if (!workspace_.pulls.pins.empty()) change("Let go of all", [](std::vector<Pull>& pins) { pins.clear(); });
}

void PinCommands::change(const std::string& label, const std::function<void(std::vector<Pull>&)>& change) {
    workspace_.document->moved(label, workspace_.playState(), false);
    change(workspace_.pulls.pins);
    workspace_.pulls.applyTo(workspace_.player->simulation());
}

}  // namespace lutka::editor
