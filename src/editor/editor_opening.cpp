#include "core/letter_case.hpp"
#include "editor/document/open_document.hpp"
#include "editor/editor.hpp"
#include "editor/files/folder_files.hpp"
#include "editor/view/select_bodies.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {

void Editor::open(const std::filesystem::path& file) {
    if (scene::isSceneFile(file)) {
        files_.afterUnsaved([this, file] { openSceneNow(file); });
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
        if (!opened) unread_ = file;
        if (!opened && scene::wantsAnyRig(opened.error())) files_.offerAnyRig(file);
        adopt(std::move(opened));
    });
}

void Editor::answerAnyRig(AnyRig answer) {
    const std::filesystem::path file = files_.takeAnyRig();
    if (answer == AnyRig::leave || file.empty()) return;
    scene::LoadOptions load = load_;
    load.fit.rig = physics::RigKind::any;
    load.fit.weighByVolume = true;
    files_.afterUnsaved([this, file, load, answer] {
        if (adopt(openModel(file, load, document())) && answer == AnyRig::byHand) onBodies(&BodyCommands::beginByHand);
    });
}

void Editor::answerOffer(bool take) {
    const std::filesystem::path file = files_.takeOffer();
    if (take && !file.empty()) open(file);
}

void Editor::openBeside(int step) {
    const std::filesystem::path file = fileBeside(unread_.empty() ? document().character().file : unread_, step);
    if (file.empty()) return workspace_.say(Toast::Kind::info, "No other model lies in this folder");
    open(file);
}

void Editor::reload() {
    const render::Camera seen = workspace_.camera;
    const std::vector<std::string> selected = namesOf(document().profile(), workspace_.selectedBodies());
    endTransform();
    auto again = reopenModel(load_, document());
    const std::string name = document().character().file.filename().string();
    if (!again) {
        workspace_.say(Toast::Kind::error, name + " can't be read again; the old one goes on. " + again.error().text());
    } else if (adopt(std::move(again), "Read again: " + name)) {
        workspace_.camera = seen;
        for (const int body : bodiesNamed(document().profile(), selected))
            select(Item{Item::Kind::body, 0, body}, true);
    }
}

void Editor::openSceneNow(const std::filesystem::path& file) {
    const auto scene = scene::loadScene(file);
    if (!scene) return workspace_.say(Toast::Kind::error, scene.error().text());
    auto other = openScene(file, scene.value(), load_, document());
    if (other && other.value() == nullptr) {
        // The character that is edited is the scene's first one: its ragdoll stays as it is.
        if (!edit([&](EditorDocument& document) { return document.useScene(file, scene.value()); })) return;
        select(std::nullopt);
        player().simulateAll();
        restart();
        camera_.frameScene();
    } else if (!adopt(std::move(other))) {
        return;
    }
    workspace_.say(Toast::Kind::info, "Opened the scene " + file.filename().string());
}

bool Editor::adopt(Result<std::unique_ptr<EditorDocument>> opened, const std::string& told) {
    if (!opened) {
        workspace_.say(Toast::Kind::error, opened.error().text());
        return false;
    }
    auto player = std::make_unique<Player>(*opened.value(), clock_);
    if (workspace_.report(player->rebuild(Player::Keep::nothing))) return false;
    unread_.clear();
    select(std::nullopt);
    workspace_.pulls.pins.clear();
    player->setPlaying(workspace_.player->playing());
    player->setSpeed(workspace_.player->speed());
    player->setSparing(workspace_.player->sparing());
    workspace_.player->endReplay();
    player->takeOver(std::move(workspace_.player->deck()));
    workspace_.player = std::move(player);  // before the document that the old one borrows
    workspace_.document = std::move(opened).value();
    workspace_.rememberBodies();
    motion_.listen();
    camera_.frameScene();
    ++characterRevision_;
    const std::filesystem::path& model = document().character().file;
    watch_.watch(model);
    workspace_.say(Toast::Kind::info, told.empty() ? "Opened " + model.filename().string() : told);
    files_.greet(told.empty());
    return true;
}

}  // namespace lutka::editor
