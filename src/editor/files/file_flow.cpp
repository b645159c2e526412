#include "editor/files/file_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/export/write_glb.hpp"
#include "core/files.hpp"
#include "scene/run/bake.hpp"

namespace lutka::editor {

bool FileFlow::anythingUnsaved() const {
    return document().unsaved() || document().sceneDocument().unsaved();
}

bool FileFlow::takesUnsaved() const {
    return workspace_.player->deck().anyUnsaved();
}

std::filesystem::path FileFlow::takeFile(const std::string& name) const {
    const std::filesystem::path& model = document().character().file;
    std::string file =
        (model.empty() ? document().character().name : model.stem().string()) + "." + name + ".recording";
    std::replace(file.begin(), file.end(), ' ', '_');
    std::replace(file.begin(), file.end(), '/', '_');
    return model.parent_path() / file;
}

bool FileFlow::saveTakes() {
    RecordingDeck& deck = workspace_.player->deck();
    workspace_.player->endReplay();
    deck.stop();
    const int current = deck.current();
    for (int take = 0; take < static_cast<int>(deck.takes().size()); ++take) {
        if (deck.takes()[static_cast<std::size_t>(take)].saved) continue;
        deck.choose(take);
        std::filesystem::path file = takeFile(deck.takes()[static_cast<std::size_t>(take)].name);
        std::error_code failed;
        // Nothing is replaced without a question: another name is found.
        for (int number = 2; std::filesystem::exists(file, failed); ++number)
            file = takeFile(fmt::format("{} {}", deck.takes()[static_cast<std::size_t>(take)].name, number));
        if (workspace_.report(deck.save(file))) return false;
        deck.markSaved();
        workspace_.say(Toast::Kind::info, "Saved the recording " + file.string());
    }
    if (current >= 0) deck.choose(current);
    return true;
}

void FileFlow::afterUnsaved(std::function<void()> then, bool endsSession) {
    askingTakes_ = endsSession && takesUnsaved();
    if (!anythingUnsaved() && !askingTakes_) {
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
    const auto saveScene = [this, whenSaved = then] {
        const auto finish = [this, whenSaved] {
            if (!askingTakes_ || saveTakes()) whenSaved();
        };
        if (!document().sceneDocument().unsaved() || requestSaveScene(document().sceneDocument().file(), finish))
            finish();
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
        exported_.push_back(file);
        const SceneDocument& scene = document().sceneDocument();
        if (scene.hasFile() && scene.unsaved()) offeredSave_ = OfferedSave::scene;
        return true;
    };
    // What the model was opened with may be another rig's profile, bound by role: it is that rig's still.
    const bool isWritten = std::find(exported_.begin(), exported_.end(), file) != exported_.end();
    const bool isForeign = document().asset().rebound && file == document().profileFile() && !isWritten;
    return writeOrAsk(file, !isForeign && !document().wouldReplace(file), write, std::move(afterwards));
}

bool FileFlow::requestSaveScene(const std::filesystem::path& file, std::function<void()> afterwards) {
    const auto write = [this, file] {
        if (workspace_.report(document().sceneDocument().save(file))) return false;
        workspace_.say(Toast::Kind::info, "Saved the scene " + file.string());
        if (document().unsaved()) offeredSave_ = OfferedSave::profile;
        return true;
    };
    const bool ours = document().sceneDocument().hasFile() && file == document().sceneDocument().file();
    return writeOrAsk(file, ours, write, std::move(afterwards));
}

void FileFlow::requestSaveRecording(const std::filesystem::path& file) {
    writeOrAsk(file, false, [this, file] {
        if (workspace_.report(workspace_.player->deck().save(file))) return false;
        workspace_.player->deck().markSaved();
        workspace_.say(Toast::Kind::info, "Saved the recording " + file.string());
        return true;
    });
}

void FileFlow::exportOrAsk(const std::filesystem::path& file, const std::function<Result<void>()>& write) {
    std::error_code failed;
    if (std::filesystem::equivalent(file, document().character().file, failed)) {
        workspace_.report(Result<void>(
            Error{ErrorCode::usage, "that file is the model itself", file.string(), "choose another name"}));
        return;
    }
    const bool ours = std::find(exported_.begin(), exported_.end(), file) != exported_.end();
    writeOrAsk(file, ours, [this, file, write] {
        if (workspace_.report(write())) return false;
        exported_.push_back(file);
        return true;
    });
}

void FileFlow::requestExport(const std::filesystem::path& file, float seconds) {
    exportOrAsk(file, [this, file, seconds] { return exportBaked(file, seconds); });
}

void FileFlow::requestExport(const std::filesystem::path& file, exporting::ExportFormat format) {
    exportOrAsk(file, [this, file, format] { return exportRagdoll(file, format); });
}

void FileFlow::saveAll() {
    // The ragdoll first: the scene names its file.
    const auto saveScene = [this] {
        const SceneDocument& scene = document().sceneDocument();
        if (scene.unsaved() && scene.hasFile()) requestSaveScene(scene.file());
        offeredSave_ = OfferedSave::none;
    };
    const bool scene = document().sceneDocument().unsaved() && document().sceneDocument().hasFile();
    if (!document().unsaved() && scene) return saveScene();
    if (requestSave(document().profileFile(), saveScene)) saveScene();
}

void FileFlow::answerOfferedSave(bool save) {
    const OfferedSave offered = std::exchange(offeredSave_, OfferedSave::none);
    if (!save) return;
    if (offered == OfferedSave::profile) requestSave(document().profileFile());
    if (offered == OfferedSave::scene) requestSaveScene(document().sceneDocument().file());
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
        player.stepOnce();
        baker.sample(simulation);
    }
    auto written = animation::writeGlb(file, document().character(), std::span(&baker.clip(), 1),
                                       simulation.worldFromModel(0), animation::KeyTolerance{});
    player.setPlaying(wasPlaying);
    if (written) workspace_.say(Toast::Kind::info, fmt::format("Exported {:.1f} s to {}", seconds, file.string()));
    return written;
}

Result<void> FileFlow::exportRagdoll(const std::filesystem::path& file, exporting::ExportFormat format) {
    const scene::RagdollAsset& asset = document().asset();
    const auto exported = exporting::exportRagdoll(format, {asset.character, asset.profile, asset.rig});
    if (!exported) return exported.error();
    auto written = writeFileAtomically(file, exported.value().bytes);
    if (!written) return written;
    for (const std::string& warning : exported.value().warnings)
        workspace_.note(Toast::Kind::warning, file.filename().string() + ": " + warning);
    const std::string told =
        exported.value().warnings.empty() ? "" : fmt::format("; {} notes in the log", exported.value().warnings.size());
    workspace_.say(Toast::Kind::info, "Exported " + file.string() + told);
    return written;
}

void FileFlow::greet(bool offerProfile) {
    for (const std::string& warning : document().character().warnings)
        workspace_.note(Toast::Kind::warning, warning);
    offeredProfile_.clear();
    const std::filesystem::path beside = document().profileFile();
    std::error_code failed;
    if (offerProfile && !document().character().file.empty() && std::filesystem::exists(beside, failed)) {
        offeredProfile_ = beside;
    }
}

}  // namespace lutka::editor
