#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "editor/states/workspace.hpp"
#include "export/export_ragdoll.hpp"

namespace lutka::editor {

/// Writes the session's files, and asks before anything is lost: unsaved changes, a file that this session neither
/// opened nor wrote, a profile beside the model. At most one question of a kind waits; what it guards is done after
/// the answer, or never.
class FileFlow {
  public:
    /// `endUnderWay` ends what the user is doing in the view, before a question is asked or the scene starts anew.
    FileFlow(Workspace& workspace, std::function<void()> endUnderWay)
        : workspace_(workspace), endUnderWay_(std::move(endUnderWay)) {}

    /// Whether a question waits that keeps the user from everything else.
    [[nodiscard]] bool asking() const { return afterAnswer_ != nullptr || replacing_.has_value(); }

    /// What waits for the answer about unsaved changes.
    enum class Answer { save, discard, cancel };
    /// Does it at once, or, with unsaved changes, after the answer. `endsSession`: takes would be lost as well.
    void afterUnsaved(std::function<void()> then, bool endsSession = false);
    [[nodiscard]] bool anythingUnsaved() const;
    /// Whether the question is about takes, too.
    [[nodiscard]] bool askingTakes() const { return askingTakes_; }
    [[nodiscard]] bool askingUnsaved() const { return afterAnswer_ != nullptr; }
    void answer(Answer answer);

    /// Saves the profile there, unless that would replace a file that the document neither opened nor wrote: then it
    /// asks first (replacedFile(), answerReplace()), and calls `afterwards` when it was saved after all. Whether it was
    /// saved now.
    bool requestSave(const std::filesystem::path& file, std::function<void()> afterwards = {});
    /// The same for the scene.
    bool requestSaveScene(const std::filesystem::path& file, std::function<void()> afterwards = {});
    [[nodiscard]] bool takesUnsaved() const;
    /// Where a take is saved when the user names no file.
    [[nodiscard]] std::filesystem::path takeFile(const std::string& name) const;
    /// And for the player's current take.
    void requestSaveRecording(const std::filesystem::path& file);
    /// And for exportBaked().
    void requestExport(const std::filesystem::path& file, float seconds);
    /// And for exportRagdoll().
    void requestExport(const std::filesystem::path& file, exporting::ExportFormat format);
    /// Ctrl+S: the profile, and the scene when it has a file. One that has none is saved by its own command: a ragdoll
    /// that is edited in a named scene should not leave scene files behind.
    void saveAll();
    /// Whoever saves one of the two is offered the other, when that has unsaved changes.
    enum class OfferedSave { none, profile, scene };
    [[nodiscard]] OfferedSave offeredSave() const { return offeredSave_; }
    void answerOfferedSave(bool save);
    /// The file that the user is asked about; empty when there is no such question.
    [[nodiscard]] std::filesystem::path replacedFile() const {
        return replacing_ ? replacing_->file : std::filesystem::path();
    }
    void answerReplace(bool replace);

    /// The first doll's motion from the scene's start, `seconds` long, as an animation of its skin (*.glb). Replaces
    /// what is there.
    [[nodiscard]] Result<void> exportBaked(const std::filesystem::path& file, float seconds);
    /// The edited ragdoll in another engine's format. Replaces what is there. What the format can't hold is told in the
    /// log.
    [[nodiscard]] Result<void> exportRagdoll(const std::filesystem::path& file, exporting::ExportFormat format);

    /// A document was opened: offers the profile that lies beside its model, when there is one and `offerProfile`.
    void greet(bool offerProfile);
    /// The profile offered; empty when there is none or the user has answered.
    [[nodiscard]] const std::filesystem::path& offeredProfile() const { return offeredProfile_; }
    /// Ends the offer; gives what was offered.
    std::filesystem::path takeOffer() { return std::exchange(offeredProfile_, {}); }

    /// A model that was refused as no humanoid can be had as a ragdoll of any skeleton.
    struct AnyRigOffer {
        std::filesystem::path model;
        std::string reason;         ///< Why it is no humanoid.
        std::optional<int> figure;  ///< Which of the file's, counted from 1; unset: the one with most vertices.
        std::filesystem::path profile = {};  ///< A human figure's, which was asked for and is of no use to this one.
    };
    void offerAnyRig(AnyRigOffer offer) { anyRig_ = std::move(offer); }
    /// Whose model is empty when there is none or the user has answered.
    [[nodiscard]] const AnyRigOffer& offeredAnyRig() const { return anyRig_; }
    AnyRigOffer takeAnyRig() { return std::exchange(anyRig_, {}); }

  private:
    using Write = std::function<bool()>;
    struct Replacing {
        std::filesystem::path file;
        Write write;
        std::function<void()> afterwards;
    };
    /// Writes now when the file is `ours` or none, else after the answer. Whether it was written now.
    bool writeOrAsk(const std::filesystem::path& file, bool ours, const Write& write,
                    std::function<void()> afterwards = {});
    /// Files that were exported before are replaced without a question.
    void exportOrAsk(const std::filesystem::path& file, const std::function<Result<void>()>& write);
    /// All takes that are in no file yet, each beside the model. Whether all could be written.
    bool saveTakes();
    [[nodiscard]] EditorDocument& document() const { return *workspace_.document; }

    Workspace& workspace_;
    std::function<void()> endUnderWay_;
    std::function<void()> afterAnswer_;
    bool askingTakes_ = false;
    std::optional<Replacing> replacing_;
    std::vector<std::filesystem::path> exported_;
    std::filesystem::path offeredProfile_;
    AnyRigOffer anyRig_;
    OfferedSave offeredSave_ = OfferedSave::none;
};

}  // namespace lutka::editor
