#include "editor/ui/user_settings.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/files.hpp"

namespace lutka::editor {

namespace {

constexpr PanelSide kSides[] = {PanelSide::left, PanelSide::right, PanelSide::bottom};

// Tabs that there are, at sides that there are; others are of another version.
void readTabs(const nlohmann::json& json, UserSettings& settings) {
    if (!json.contains("tabs") || !json["tabs"].is_object()) return;
    for (const PanelTab& tab : panelTabs()) {
        const auto moved = json["tabs"].find(tab.name);
        if (moved == json["tabs"].end() || !moved->is_string()) continue;
        for (const PanelSide side : kSides) {
            if (moved->get<std::string>() == panelSideName(side)) settings.tabSides[tab.name] = side;
        }
    }
}

}  // namespace

void UserSettings::remember(const std::filesystem::path& file) {
    std::error_code failed;
    const std::filesystem::path whole = std::filesystem::absolute(file, failed);
    if (failed || file.empty()) return;
    std::erase(recent, whole);
    recent.insert(recent.begin(), whole);
    if (recent.size() > kMaxRecent) recent.resize(kMaxRecent);
}

std::filesystem::path userSettingsFile() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    if (config != nullptr && *config != '\0') return std::filesystem::path(config) / "lutka" / "editor.json";
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return std::filesystem::path(home) / ".config" / "lutka" / "editor.json";
    return {};
}

UserSettings loadUserSettings(const std::filesystem::path& file) {
    UserSettings settings;
    if (file.empty() || !std::filesystem::exists(file)) return settings;
    constexpr std::size_t maxBytes = 1U << 20U;
    const auto bytes = readFile(file, maxBytes);
    if (!bytes) return settings;
    const auto json = nlohmann::json::parse(bytes.value(), nullptr, false);
    if (!json.is_object()) return settings;
    if (json.contains("allowOutside") && json["allowOutside"].is_boolean())
        settings.allowOutside = json["allowOutside"].get<bool>();
    const auto number = [&](const char* key, float low, float high, float& value) {
        if (!json.contains(key) || !json[key].is_number()) return;
        const auto read = json[key].get<float>();
        if (read >= low && read <= high) value = read;
    };
    number("uiScale", 0.5F, 4.0F, settings.uiScale);
    number("leftWidth", 100.0F, 4000.0F, settings.leftWidth);
    number("rightWidth", 100.0F, 4000.0F, settings.rightWidth);
    number("bottomHeight", 50.0F, 4000.0F, settings.bottomHeight);
    readTabs(json, settings);
    if (!json.contains("recent") || !json["recent"].is_array()) return settings;
    for (const auto& one : json["recent"]) {
        if (one.is_string() && settings.recent.size() < UserSettings::kMaxRecent) {
            settings.recent.emplace_back(one.get<std::string>());
        }
    }
    return settings;
}

void saveUserSettings(const std::filesystem::path& file, const UserSettings& settings) {
    if (file.empty()) return;
    nlohmann::ordered_json json = {
        {"version", 1}, {"allowOutside", settings.allowOutside}, {"recent", nlohmann::ordered_json::array()}};
    if (settings.uiScale > 0.0F) json["uiScale"] = settings.uiScale;
    if (settings.leftWidth > 0.0F) json["leftWidth"] = settings.leftWidth;
    if (settings.rightWidth > 0.0F) json["rightWidth"] = settings.rightWidth;
    if (settings.bottomHeight > 0.0F) json["bottomHeight"] = settings.bottomHeight;
    for (const auto& [name, side] : settings.tabSides)
        json["tabs"][name] = panelSideName(side);
    for (const std::filesystem::path& one : settings.recent)
        json["recent"].push_back(one.string());
    using Handler = nlohmann::ordered_json::error_handler_t;
    const auto written = writeFileAtomically(file, json.dump(2, ' ', false, Handler::replace) + '\n');
    if (!written) spdlog::warn("{}", written.error().text());
}

}  // namespace lutka::editor
