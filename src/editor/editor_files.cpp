/// Editor's files: opening, saving and exporting, with the questions that they ask.

#include <fmt/format.h>

#include <algorithm>

#include "animation/export/write_glb.hpp"
#include "editor/editor.hpp"
#include "scene/bake.hpp"
#include "scene/scene_file.hpp"

namespace lutka::editor {
namespace {

bool isProfile(const std::filesystem::path& file) {
    return file.extension() == ".json";
}

}  // namespace

// The scene's own view, a little farther off: bars lie over the picture's edges.
render::Camera Editor::startCamera(const scene::Simulation& simulation, render::Extent window) {
    constexpr float room = 1.15F;
    render::Camera camera = scene::cameraFor(simulation.scenario(), window.aspect());
    if (!simulation.scenario().camera) render::dolly(camera, room);
    return camera;
}

void Editor::afterUnsaved(std::function<void()> then) {
    if (!anythingUnsaved()) {
        then();
        return;
    }
    endTransform();
    afterAnswer_ = std::move(then);
}

void Editor::answer(Answer answer) {
    const auto then = std::exchange(afterAnswer_, nullptr);
    if (then == nullptr || answer == Answer::cancel) return;
    if (answer == Answer::discard) {
        then();
        return;
    }
    const auto saveScene = [this, then] {
        if (!document().sceneUnsaved() || requestSaveScene(document().sceneFile(), then)) then();
    };
    if (!document().unsaved() || requestSave(document().profileFile(), saveScene)) saveScene();
}

bool Editor::requestSave(const std::filesystem::path& file, std::function<void()> afterwards) {
    if (!document().wouldReplace(file)) return !workspace_.report(save(file));
    endTransform();
    const auto write = [this, file] { return !workspace_.report(save(file)); };
    replacing_ = Replacing{file, write, std::move(afterwards)};
    return false;
}

void Editor::requestExport(const std::filesystem::path& file, float seconds) {
    const auto write = [this, file, seconds] {
        if (workspace_.report(exportBaked(file, seconds))) return false;
        exported_.push_back(file);
        return true;
    };
    std::error_code failed;
    const bool ours = std::find(exported_.begin(), exported_.end(), file) != exported_.end();
    if (ours || !std::filesystem::exists(file, failed)) {
        write();
        return;
    }
    replacing_ = Replacing{file, write, {}};
}

void Editor::answerReplace(bool replace) {
    const auto question = std::exchange(replacing_, std::nullopt);
    if (!question || !replace || !question->write()) return;
    if (question->afterwards) question->afterwards();
}

void Editor::greet(bool offerProfile) {
    for (const std::string& warning : document().character().warnings)
        workspace_.log.push_back({Toast::Kind::warning, warning});
    offeredProfile_.clear();
    const std::filesystem::path beside = document().profileFile();
    std::error_code failed;
    if (offerProfile && !document().character().file.empty() && std::filesystem::exists(beside, failed)) {
        offeredProfile_ = beside;
    }
}

void Editor::answerOffer(bool take) {
    const std::filesystem::path file = std::exchange(offeredProfile_, {});
    if (take && !file.empty()) open(file);
}

void Editor::open(const std::filesystem::path& file) {
    if (scene::isSceneFile(file)) {
        afterUnsaved([this, file] { openSceneNow(file); });
        return;
    }
    if (isProfile(file)) {
        offeredProfile_.clear();
        if (edit([&](EditorDocument& document) { return document.useProfile(file); })) {
            workspace_.say(Toast::Kind::info, "Opened the profile " + file.filename().string());
        }
        return;
    }
    afterUnsaved([this, file] { openNow(file); });
}

void Editor::openNow(const std::filesystem::path& file) {
    scene::LoadOptions load = load_;
    load.profile.reset();  // it belongs to the first model
    auto opened = EditorDocument::open(file, load);
    if (!opened) {
        workspace_.say(Toast::Kind::error, opened.error().text());
        return;
    }
    adopt(std::move(opened).value());
}

// The new character takes the place of the old one in the scene.
void Editor::adopt(std::unique_ptr<EditorDocument> document) {
    SceneSettings settings = workspace_.document->state().scene;
    for (scene::Ragdoll& ragdoll : settings.entities.all<scene::Ragdoll>()) {
        if (!workspace_.document->isEdited(ragdoll)) continue;
        ragdoll.model.clear();
        ragdoll.profile.clear();
        ragdoll.clip.reset();  // of the old one
    }
    if (workspace_.report(document->startScene(settings))) return;
    adoptStarted(std::move(document));
}

void Editor::adoptStarted(std::unique_ptr<EditorDocument> document) {
    auto player = std::make_unique<Player>(*document, clock_);
    if (workspace_.report(player->rebuild(Player::Keep::nothing))) return;
    select(std::nullopt);
    workspace_.pulls.pins.clear();
    player->setPlaying(workspace_.player->playing());
    player->setSpeed(workspace_.player->speed());
    player->setSparing(workspace_.player->sparing());
    workspace_.player = std::move(player);  // before the document that the old one borrows
    workspace_.document = std::move(document);
    workspace_.camera = startCamera(workspace_.player->simulation(), workspace_.window);
    ++characterRevision_;
    workspace_.say(Toast::Kind::info, "Opened " + this->document().character().file.filename().string());
    greet(true);
}

Result<void> Editor::save(const std::filesystem::path& file) {
    auto saved = document().save(file);
    if (saved) workspace_.say(Toast::Kind::info, "Saved " + file.string());
    return saved;
}

Result<void> Editor::exportBaked(const std::filesystem::path& file, float seconds) {
    endTransform();
    if (player().simulation().dollCount() == 0 || !player().isEditedDoll(0)) {
        return Error{ErrorCode::usage, "the first character of the scene is not the one that is edited", "",
                     "press \"Edit this character\" on it first"};
    }
    const bool wasPlaying = player().playing();
    // The document's asset lends itself to one simulation at a time: the export takes the scene from its start.
    if (auto reset = player().reset(); !reset) return reset;
    scene::Simulation& simulation = player().simulation();
    const float rate = 1.0F / simulation.options().dt;
    scene::ClipBaker baker(0, rate, "lutka_" + document().scene().name);
    baker.sample(simulation);
    for (int step = 0; step < static_cast<int>(std::lround(seconds * rate)); ++step) {
        simulation.step();
        baker.sample(simulation);
    }
    auto written =
        animation::writeGlb(file, document().character(), std::span(&baker.clip(), 1), simulation.worldFromModel(0));
    player().setPlaying(wasPlaying);
    if (written) workspace_.say(Toast::Kind::info, fmt::format("Exported {:.1f} s to {}", seconds, file.string()));
    return written;
}

}  // namespace lutka::editor
