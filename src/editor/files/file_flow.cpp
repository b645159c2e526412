#include "editor/files/file_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/export/write_glb.hpp"
#include "scene/bake.hpp"

namespace lutka::editor {

bool FileFlow::anythingUnsaved() const {
    return document().unsaved() || document().sceneDocument().unsaved();
}

void FileFlow::afterUnsaved(std::function<void()> then) {
    if (!anythingUnsaved()) {
        then();
        return;
    }
    endUnderWay_();
    afterAnswer_ = std::move(then);
}

void FileFlow::answer(Answer answer) {
    const auto then = std::exchange(afterAnswer_, nullptr);
    if (then == nullptr || answer == Answer::cancel) return;
    if (answer == Answer::discard) {
        then();
        return;
    }
    const auto saveScene = [this, then] {
        if (!document().sceneDocument().unsaved() || requestSaveScene(document().sceneDocument().file(), then)) then();
    };
    if (!document().unsaved() || requestSave(document().profileFile(), saveScene)) saveScene();
}

bool FileFlow::writeOrAsk(const std::filesystem::path& file, bool ours, const Write& write,
                          std::function<void()> afterwards) {
    std::error_code failed;
    if (ours || !std::filesystem::exists(file, failed)) return write();
    endUnderWay_();
    replacing_ = Replacing{file, write, std::move(afterwards)};
    return false;
}

void FileFlow::answerReplace(bool replace) {
    const auto question = std::exchange(replacing_, std::nullopt);
    if (!question || !replace || !question->write()) return;
    if (question->afterwards) question->afterwards();
}

bool FileFlow::requestSave(const std::filesystem::path& file, std::function<void()> afterwards) {
    const auto write = [this, file] {
        if (workspace_.report(document().save(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved " + file.string());
        return true;
    };
    return writeOrAsk(file, !document().wouldReplace(file), write, std::move(afterwards));
}

bool FileFlow::requestSaveScene(const std::filesystem::path& file, std::function<void()> afterwards) {
    const auto write = [this, file] {
        if (workspace_.report(document().sceneDocument().save(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved the scene " + file.string());
        if (document().unsaved()) {
            workspace_.say(Toast::Kind::warning, "The ragdoll itself has unsaved changes: Ctrl+S saves its profile");
        }
        return true;
    };
    const bool ours = document().sceneDocument().hasFile() && file == document().sceneDocument().file();
    return writeOrAsk(file, ours, write, std::move(afterwards));
}

void FileFlow::requestSaveRecording(const std::filesystem::path& file) {
    writeOrAsk(file, false, [this, file] {
        if (workspace_.report(workspace_.player->deck().save(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved the recording " + file.string());
        return true;
    });
}

void FileFlow::requestExport(const std::filesystem::path& file, float seconds) {
    const bool ours = std::find(exported_.begin(), exported_.end(), file) != exported_.end();
    writeOrAsk(file, ours, [this, file, seconds] {
        if (workspace_.report(exportBaked(file, seconds))) return false;
        exported_.push_back(file);
        return true;
    });
}

void FileFlow::saveAll() {
    const bool scene = document().sceneDocument().unsaved() && document().sceneDocument().hasFile();
    if (scene) requestSaveScene(document().sceneDocument().file());
    if (document().unsaved() || !scene) requestSave(document().profileFile());
}

Result<void> FileFlow::exportBaked(const std::filesystem::path& file, float seconds) {
    endUnderWay_();
    Player& player = *workspace_.player;
    if (player.simulation().dollCount() == 0 || !player.isEditedDoll(0)) {
        return Error{ErrorCode::usage, "the first character of the scene is not the one that is edited", "",
                     "press \"Edit this character\" on it first"};
    }
    const bool wasPlaying = player.playing();
    // The document's asset lends itself to one simulation at a time: the export takes the scene from its start.
    if (auto reset = player.reset(); !reset) return reset;
    scene::Simulation& simulation = player.simulation();
    const float rate = 1.0F / simulation.options().dt;
    scene::ClipBaker baker(0, rate, "lutka_" + document().scene().name);
    baker.sample(simulation);
    for (int step = 0; step < static_cast<int>(std::lround(seconds * rate)); ++step) {
        simulation.step();
        baker.sample(simulation);
    }
    auto written =
        animation::writeGlb(file, document().character(), std::span(&baker.clip(), 1), simulation.worldFromModel(0));
    player.setPlaying(wasPlaying);
    if (written) workspace_.say(Toast::Kind::info, fmt::format("Exported {:.1f} s to {}", seconds, file.string()));
    return written;
}

void FileFlow::greet(bool offerProfile) {
    for (const std::string& warning : document().character().warnings)
        workspace_.log.push_back({Toast::Kind::warning, warning});
    offeredProfile_.clear();
    const std::filesystem::path beside = document().profileFile();
    std::error_code failed;
    if (offerProfile && !document().character().file.empty() && std::filesystem::exists(beside, failed)) {
        offeredProfile_ = beside;
    }
}

}  // namespace lutka::editor
