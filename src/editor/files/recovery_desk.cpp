#include "editor/files/recovery_desk.hpp"

#include "core/assert.hpp"

namespace lutka::editor {

Result<void> RecoveryDesk::begin(const std::filesystem::path& folder) {
    if (folder.empty()) return {};
    offers_ = findRecoveries(folder);
    auto keeper = RecoveryKeeper::create(folder);
    if (!keeper) return keeper.error();
    keeper_ = std::move(keeper).value();
    return {};
}

void RecoveryDesk::set(Answer answer) {
    if (offers_.empty()) return;
    if (answer == Answer::remove) removeRecovery(offers_.front());
    offers_.erase(offers_.begin());
}

Result<std::unique_ptr<EditorDocument>> RecoveryDesk::restore(scene::LoadOptions load) const {
    LUTKA_ASSERT(!offers_.empty());
    const RecoveryCopy& copy = offers_.front();
    std::error_code failed;
    load.profile.reset();
    if (!copy.profile.empty() && std::filesystem::exists(copy.profile, failed)) load.profile = copy.profile;
    auto opened = EditorDocument::open(copy.model, load);
    if (!opened) return opened;
    if (!copy.scene.empty()) opened.value()->sceneDocument().setFile(copy.scene);
    if (auto put = recoverInto(*opened.value(), copy); !put) return put.error();
    return opened;
}

Result<void> RecoveryDesk::restored(const EditorDocument& document) {
    const RecoveryCopy copy = offers_.front();
    offers_.erase(offers_.begin());
    if (auto kept = keep(document); !kept) return kept;
    if (keeper_ != nullptr) removeRecovery(copy);
    return {};
}

Result<void> RecoveryDesk::update(const EditorDocument& document, double seconds) {
    return keeper_ != nullptr ? keeper_->update(document, seconds) : Result<void>();
}

Result<void> RecoveryDesk::keep(const EditorDocument& document) {
    return keeper_ != nullptr ? keeper_->keep(document) : Result<void>();
}

void RecoveryDesk::end() {
    if (keeper_ != nullptr) keeper_->end();
}

}  // namespace lutka::editor
