#include "editor/files/recovery.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/files.hpp"
#include "core/json/json_text.hpp"
#include "physics/profile/profile_io.hpp"
#include "scene/description/scene_file.hpp"

namespace lutka::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInfo = "copy.json";
constexpr const char* kProfile = "ragdoll.json";
constexpr const char* kScene = "scene.json";
constexpr const char* kLock = "lock";
constexpr const char* kPrefix = "session-";
constexpr int kNoLock = -1;

// The lock goes with the process, however that ends.
int lockFile(const fs::path& file, bool wait) {
    const int descriptor = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor < 0) return kNoLock;
    if (::flock(descriptor, LOCK_EX | (wait ? 0 : LOCK_NB)) == 0) return descriptor;
    ::close(descriptor);
    return kNoLock;
}

void unlock(int lock) {
    if (lock != kNoLock) ::close(lock);
}

/// Keeps sessions that begin from each other's half-made folders.
class FolderGuard {
  public:
    explicit FolderGuard(const fs::path& folder) : lock_(lockFile(folder / kLock, true)) {}
    ~FolderGuard() { unlock(lock_); }
    FolderGuard(const FolderGuard&) = delete;
    FolderGuard& operator=(const FolderGuard&) = delete;

  private:
    int lock_;
};

std::vector<fs::path> sessionsIn(const fs::path& folder) {
    std::vector<fs::path> sessions;
    std::error_code failed;
    fs::directory_iterator at(folder, failed);
    for (; !failed && at != fs::directory_iterator(); at.increment(failed)) {
        if (at->path().filename().string().starts_with(kPrefix)) sessions.push_back(at->path());
    }
    return sessions;
}

std::string localTime() {
    return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr)));
}

nlohmann::ordered_json fixedJson(const EditorDocument& document) {
    nlohmann::ordered_json fixed = nlohmann::ordered_json::object();
    for (int role = 0; role < animation::kRoleCount; ++role) {
        const std::optional<int>& joint = document.state().fixed[role];
        if (joint) fixed[std::string(animation::roleName(animation::roleAt(role)))] = *joint;
    }
    return fixed;
}

std::string textOf(const nlohmann::json& json, const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

bool truthOf(const nlohmann::json& json, const char* key) {
    return json.contains(key) && json[key].is_boolean() && json[key].get<bool>();
}

void readFixed(const nlohmann::json& json, RecoveryCopy& copy) {
    if (!json.contains("fixed") || !json["fixed"].is_object()) return;
    for (int role = 0; role < animation::kRoleCount; ++role) {
        const std::string name(animation::roleName(animation::roleAt(role)));
        const auto& all = json["fixed"];
        if (all.contains(name) && all[name].is_number_integer()) copy.fixed[role] = all[name].get<int>();
    }
}

void readNamedScene(const nlohmann::json& json, RecoveryCopy& copy) {
    constexpr std::size_t most = 100000;
    copy.scenario = textOf(json, "scenario");
    if (json.contains("count") && json["count"].is_number_integer())
        copy.count = std::clamp(json["count"].get<int>(), 1, 10000);
    if (json.contains("seed") && json["seed"].is_number_unsigned()) copy.seed = json["seed"].get<std::uint64_t>();
    if (!json.contains("made") || !json["made"].is_array() || json["made"].size() > most) return;
    for (const auto& id : json["made"]) {
        if (id.is_number_unsigned()) copy.made.push_back(id.get<scene::EntityId>());
    }
    std::sort(copy.made.begin(), copy.made.end());
}

std::optional<RecoveryCopy> readCopy(const fs::path& folder) {
    constexpr std::size_t maxBytes = 8U << 20U;
    const auto bytes = readFile(folder / kInfo, maxBytes);
    if (!bytes) return std::nullopt;
    const auto json = nlohmann::json::parse(bytes.value(), nullptr, false);
    if (!json.is_object() || textOf(json, "format") != "lutka.recovery") return std::nullopt;
    RecoveryCopy copy;
    copy.folder = folder;
    copy.model = textOf(json, "model");
    copy.profile = textOf(json, "profile");
    copy.scene = textOf(json, "scene");
    copy.holdsRagdoll = truthOf(json, "holdsRagdoll");
    copy.holdsScene = truthOf(json, "holdsScene");
    copy.when = textOf(json, "when");
    readFixed(json, copy);
    readNamedScene(json, copy);
    return copy;
}

Error cannotKeep(const fs::path& folder, const std::string& why) {
    return {ErrorCode::output, fmt::format("unsaved work can't be kept safe: {}", why), folder.string(),
            "save often, or make the folder writable"};
}

}  // namespace

fs::path recoveryFolder() {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && *state != '\0') return fs::path(state) / "lutka" / "recovery";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".local" / "state" / "lutka" / "recovery";
    return {};
}

std::string RecoveryCopy::contents() const {
    const std::string ragdoll = "the ragdoll of " + model.filename().string();
    const std::string of = scene.empty() ? scenario : scene.filename().string();
    const std::string place = of.empty() ? "the scene" : "the scene " + of;
    if (holdsRagdoll && holdsScene) return ragdoll + " and " + place;
    return holdsRagdoll ? ragdoll : place + " with " + model.filename().string();
}

std::vector<RecoveryCopy> findRecoveries(const fs::path& folder) {
    std::vector<RecoveryCopy> found;
    std::error_code failed;
    if (folder.empty() || !fs::is_directory(folder, failed)) return found;
    const FolderGuard guard(folder);
    for (const fs::path& session : sessionsIn(folder)) {
        const int lock = lockFile(session / kLock, false);
        if (lock == kNoLock) continue;  // its session lives
        if (auto copy = readCopy(session)) {
            found.push_back(std::move(*copy));
        } else if (!fs::exists(session / kInfo, failed)) {
            fs::remove_all(session, failed);
        }
        unlock(lock);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.when > b.when; });
    return found;
}

void removeRecovery(const RecoveryCopy& copy) {
    std::error_code failed;
    fs::remove_all(copy.folder, failed);
}

Result<void> recoverInto(EditorDocument& document, const RecoveryCopy& copy) {
    if (copy.holdsScene) {
        auto scene = scene::loadScene(copy.folder / kScene);
        if (!scene) return scene.error();
        SceneSettings settings = document.sceneDocument().settings();
        settings.entities = std::move(scene).value();
        settings.scenario = copy.scenario;
        settings.count = copy.count;
        settings.seed = copy.seed;
        settings.made = copy.made;
        if (auto done = document.recoverScene(settings); !done) return done;
    }
    if (!copy.holdsRagdoll) return {};
    const auto profile = physics::loadProfile(copy.folder / kProfile);
    if (!profile) return profile.error();
    auto fixed = copy.fixed;
    for (std::optional<int>& joint : fixed) {
        if (joint && (*joint < animation::kNoJoint || *joint >= document.character().skeleton.jointCount())) {
            joint.reset();  // the model has changed since
        }
    }
    return document.recover(fixed, profile.value());
}

Result<std::unique_ptr<RecoveryKeeper>> RecoveryKeeper::create(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) return cannotKeep(folder, failed.message());
    const FolderGuard guard(folder);
    std::string own = (folder / kPrefix).string() + "XXXXXX";
    if (::mkdtemp(own.data()) == nullptr) return cannotKeep(folder, "no folder can be made in it");
    const int lock = lockFile(fs::path(own) / kLock, false);
    if (lock == kNoLock) return cannotKeep(own, "its lock can't be made");
    std::unique_ptr<RecoveryKeeper> keeper(new RecoveryKeeper(own, lock));
    keeper->since_ = 0.0;  // the first change of a drag is not worth a copy
    return keeper;
}

RecoveryKeeper::~RecoveryKeeper() {
    std::error_code failed;
    if (!holds_) fs::remove_all(folder_, failed);
    unlock(lock_);
}

Result<void> RecoveryKeeper::update(const EditorDocument& document, double seconds) {
    since_ += seconds;
    if (!document.unsaved() && !document.sceneDocument().unsaved()) {
        drop();
        return {};
    }
    if ((holds_ && kept_ == document.revision()) || since_ < kInterval) return {};
    since_ = 0.0;
    auto kept = keep(document);
    if (kept || failed_) return {};
    failed_ = true;
    return kept;
}

Result<void> RecoveryKeeper::keep(const EditorDocument& document) {
    const SceneDocument& scene = document.sceneDocument();
    const bool ragdoll = document.unsaved();
    if (!ragdoll && !scene.unsaved()) return {};
    std::error_code failed;
    const auto absolute = [&](const fs::path& file) {
        return file.empty() ? std::string() : fs::absolute(file, failed).string();
    };
    // Its parts first: a copy without its first page is none.
    if (ragdoll) {
        auto saved = physics::saveProfile(folder_ / kProfile, document.profile());
        if (!saved) return saved;
    }
    if (auto saved = scene.write(folder_ / kScene); !saved) return saved;
    nlohmann::ordered_json json{{"format", "lutka.recovery"},
                                {"version", 1},
                                {"model", absolute(document.character().file)},
                                {"profile", absolute(document.openedFile())},
                                {"scene", scene.hasFile() ? absolute(scene.file()) : ""},
                                {"holdsRagdoll", ragdoll},
                                {"holdsScene", scene.unsaved()},
                                {"when", localTime()},
                                {"scenario", scene.settings().scenario},
                                {"count", scene.settings().count},
                                {"seed", scene.settings().seed},
                                {"fixed", fixedJson(document)},
                                {"made", scene.settings().made}};
    using Handler = nlohmann::ordered_json::error_handler_t;
    auto written = writeFileAtomically(folder_ / kInfo, json.dump(2, ' ', false, Handler::replace) + '\n');
    if (!written) return written;
    holds_ = true;
    kept_ = document.revision();
    return {};
}

void RecoveryKeeper::drop() {
    if (!holds_) return;
    std::error_code failed;
    for (const char* part : {kInfo, kProfile, kScene})
        fs::remove(folder_ / part, failed);
    holds_ = false;
}

void RecoveryKeeper::end() {
    drop();
}

}  // namespace lutka::editor
