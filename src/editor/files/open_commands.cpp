#include "editor/files/open_commands.hpp"

#include "core/letter_case.hpp"
#include "editor/document/open_document.hpp"
#include "editor/files/folder_files.hpp"
#include "editor/states/body_commands.hpp"
#include "editor/view/select_bodies.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {

void OpenCommands::begin(const scene::LoadOptions& load, scene::FrameLoop::Clock clock) {
    load_ = load;
    clock_ = std::move(clock);
}

void OpenCommands::take(std::unique_ptr<EditorDocument> document, std::unique_ptr<Player> player) {
    workspace_.player = std::move(player);  // before the document that the old one borrows
    workspace_.document = std::move(document);
    workspace_.rememberBodies();
    motion_.listen();
    camera_.frameScene();
    watch_.watch(workspace_.document->character().file);
}

bool OpenCommands::adopt(Result<std::unique_ptr<EditorDocument>> opened, const std::string& told) {
    if (!opened) {
        workspace_.say(Toast::Kind::error, opened.error().text());
        return false;
    }
    auto player = std::make_unique<Player>(*opened.value(), clock_);
    if (workspace_.report(player->rebuild(Player::Keep::nothing))) return false;
    unread_.clear();
    selectNothing();
    workspace_.pulls.pins.clear();
    Player& present = *workspace_.player;
    player->setPlaying(present.playing());
    player->setSpeed(present.speed());
    player->setSparing(present.sparing());
    present.endReplay();
    player->takeOver(std::move(present.deck()));
    take(std::move(opened).value(), std::move(player));
    ++characterRevision_;
    workspace_.say(Toast::Kind::info,
                   told.empty() ? "Opened " + document().character().file.filename().string() : told);
    files_.greet(told.empty());
    return true;
}

void OpenCommands::open(const std::filesystem::path& file) {
    if (scene::isSceneFile(file)) {
        files_.afterUnsaved([this, file] { openScene(file); });
        return;
    }
    if (sameButCase(file.extension().string(), ".json")) {
        files_.takeOffer();
        if (edit([&](EditorDocument& document) { return document.useProfile(file); })) {
            workspace_.say(Toast::Kind::info, profileNews(document(), file));
        }
        return;
    }
    files_.takeAnyRig();
    files_.afterUnsaved([this, file] {
        auto opened = openModel(file, load_, document());
        if (opened || !scene::wantsAnyRig(opened.error())) {
            if (!opened) unread_ = file;
            adopt(std::move(opened));
        } else {
            offerAnyRig({file, opened.error().message, {}});
        }
    });
}

// The offer tells the reason: a message beside it would only lie over it.
void OpenCommands::offerAnyRig(FileFlow::AnyRigOffer offer) {
    unread_ = offer.model;
    workspace_.note(Toast::Kind::error, offer.model.string() + ": " + offer.reason);
    files_.offerAnyRig(std::move(offer));
}

void OpenCommands::openFigure(int figure) {
    files_.takeAnyRig();
    files_.afterUnsaved([this, figure] {
        const std::filesystem::path file = document().character().file;
        scene::Ragdoll taken;
        taken.figure = figure;
        auto opened = openModel(file, load_, document(), taken);
        if (!opened && scene::wantsAnyRig(opened.error())) return offerAnyRig({file, opened.error().message, figure});
        adopt(std::move(opened));
    });
}

void OpenCommands::answerAnyRig(AnyRig answer) {
    const FileFlow::AnyRigOffer offer = files_.takeAnyRig();
    if (answer == AnyRig::leave || offer.model.empty()) return;
    scene::Ragdoll taken;
    taken.figure = offer.figure;
    taken.rig = physics::RigKind::any;
    files_.afterUnsaved([this, offer, taken, answer] {
        if (!adopt(openModel(offer.model, load_, document(), taken)) || answer != AnyRig::byHand) return;
        BodyCommands(workspace_).beginByHand();
        settle_();
    });
}

void OpenCommands::answerOffer(bool take) {
    const std::filesystem::path file = files_.takeOffer();
    if (take && !file.empty()) open(file);
}

void OpenCommands::openBeside(int step) {
    const std::filesystem::path file = fileBeside(unread_.empty() ? document().character().file : unread_, step);
    if (file.empty()) return workspace_.say(Toast::Kind::info, "No other model lies in this folder");
    open(file);
}

void OpenCommands::reload() {
    const render::Camera seen = workspace_.camera;
    const std::vector<std::string> selected = namesOf(document().profile(), workspace_.selectedBodies());
    settle_();
    auto again = reopenModel(load_, document());
    const std::string name = document().character().file.filename().string();
    if (!again) {
        workspace_.say(Toast::Kind::error, name + " can't be read again; the old one goes on. " + again.error().text());
    } else if (adopt(std::move(again), "Read again: " + name)) {
        workspace_.camera = seen;
        for (const int body : bodiesNamed(document().profile(), selected))
            workspace_.selection.toggle(Item{Item::Kind::body, 0, body});
        settle_();
    }
}

void OpenCommands::openScene(const std::filesystem::path& file) {
    const auto scene = scene::loadScene(file);
    if (!scene) return workspace_.say(Toast::Kind::error, scene.error().text());
    auto other = editor::openScene(file, scene.value(), load_, document());
    if (other && other.value() == nullptr) {
        // The character that is edited is the scene's first one: its ragdoll stays as it is.
        if (!edit([&](EditorDocument& document) { return document.useScene(file, scene.value()); })) return;
        selectNothing();
        workspace_.player->simulateAll();
        motion_.restart();
        camera_.frameScene();
    } else if (!adopt(std::move(other))) {
        return;
    }
    workspace_.say(Toast::Kind::info, "Opened the scene " + file.filename().string());
}

void OpenCommands::editCharacter(scene::EntityId character) {
    const auto* ragdoll = document().scene().find<scene::Ragdoll>(character);
    if (ragdoll == nullptr) return;
    const auto change = [this, wanted = *ragdoll] {
        const render::Camera seen = workspace_.camera;
        if (adopt(openCharacter(wanted, load_, document()))) workspace_.camera = seen;
    };
    if (document().unsaved()) {
        files_.afterUnsaved(change);
    } else {
        change();
    }
}

void OpenCommands::endUnderWay() {
    settle_();
    motion_.endSwing();
}

bool OpenCommands::edit(const std::function<Result<void>(EditorDocument&)>& change) {
    endUnderWay();
    const bool done = workspace_.edit(change);
    settle_();
    return done;
}

void OpenCommands::selectNothing() {
    endUnderWay();
    workspace_.selection.clear();
    settle_();
}

}  // namespace lutka::editor
