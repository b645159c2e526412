#include "editor/input/input_script.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/files.hpp"

namespace lutka::editor {
namespace {

using Json = nlohmann::ordered_json;
using Kind = InputEvent::Kind;

constexpr std::array<std::pair<Kind, std::string_view>, 9> kKinds = {{
    {Kind::mouseMove, "mouseMove"},
    {Kind::mouseButton, "mouseButton"},
    {Kind::wheel, "wheel"},
    {Kind::key, "key"},
    {Kind::text, "text"},
    {Kind::drop, "drop"},
    {Kind::resize, "resize"},
    {Kind::focus, "focus"},
    {Kind::close, "close"},
}};
constexpr std::array<std::string_view, kMouseButtonCount> kButtons = {"left", "right", "middle"};
constexpr int kMaxWindowSide = 16384;

std::string_view kindName(Kind kind) {
    return kKinds[static_cast<std::size_t>(kind)].second;
}

void writeModifiers(Json& json, const Modifiers& modifiers) {
    Json held = Json::array();
    if (modifiers.shift) held.push_back("shift");
    if (modifiers.control) held.push_back("control");
    if (modifiers.alt) held.push_back("alt");
    if (!held.empty()) json["modifiers"] = std::move(held);
}

Json toJson(const InputScript::Entry& entry) {
    const InputEvent& event = entry.event;
    Json json = {{"frame", entry.frame}, {"event", kindName(event.kind)}};
    switch (event.kind) {
        case Kind::mouseMove:
            json["x"] = event.position.x;
            json["y"] = event.position.y;
            break;
        case Kind::mouseButton:
            json["button"] = kButtons[static_cast<std::size_t>(event.button)];
            json["pressed"] = event.pressed;
            writeModifiers(json, event.modifiers);
            break;
        case Kind::wheel:
            json["notches"] = event.wheel;
            break;
        case Kind::key:
            json["key"] = keyName(event.key);
            json["pressed"] = event.pressed;
            if (event.repeated) json["repeated"] = true;
            writeModifiers(json, event.modifiers);
            break;
        case Kind::text:
            json["codepoint"] = event.codepoint;
            break;
        case Kind::drop:
            json["files"] = event.files;
            break;
        case Kind::resize:
            json["size"] = {event.size.width, event.size.height};
            break;
        case Kind::focus:
            json["gained"] = event.pressed;
            break;
        case Kind::close:
            break;
    }
    return json;
}

// Everything below throws std::string with what is wrong in a line; scriptFromText() catches it and adds the place.
[[noreturn]] void wrong(std::string what) {
    throw std::move(what);
}

Modifiers readModifiers(const Json& json) {
    Modifiers modifiers;
    if (!json.contains("modifiers")) return modifiers;
    for (const Json& word : json.at("modifiers")) {
        const auto name = word.get<std::string>();
        if (name == "shift") {
            modifiers.shift = true;
        } else if (name == "control") {
            modifiers.control = true;
        } else if (name == "alt") {
            modifiers.alt = true;
        } else {
            wrong(fmt::format("unknown modifier \"{}\": shift, control or alt is expected", name));
        }
    }
    return modifiers;
}

render::Extent readSize(const Json& json) {
    const render::Extent size{json.at(0).get<int>(), json.at(1).get<int>()};
    if (json.size() != 2 || size.width < 1 || size.height < 1 || size.width > kMaxWindowSide ||
        size.height > kMaxWindowSide) {
        wrong(fmt::format("a size is [width, height], each in [1, {}]", kMaxWindowSide));
    }
    return size;
}

float readFinite(const Json& json, const char* key) {
    const float value = json.at(key).get<float>();
    if (!std::isfinite(value)) wrong(fmt::format("\"{}\" is not a finite number", key));
    return value;
}

MouseButton readButton(const Json& json) {
    const auto name = json.at("button").get<std::string>();
    const auto* const found = std::find(kButtons.begin(), kButtons.end(), name);
    if (found == kButtons.end()) wrong(fmt::format("unknown button \"{}\": left, right or middle is expected", name));
    return static_cast<MouseButton>(found - kButtons.begin());
}

Key readKey(const Json& json) {
    const auto name = json.at("key").get<std::string>();
    const auto key = keyFromName(name);
    if (!key) wrong(fmt::format("unknown key \"{}\"", name));
    return *key;
}

void readMembers(const Json& json, InputEvent& event) {
    switch (event.kind) {
        case Kind::mouseMove:
            event.position = {readFinite(json, "x"), readFinite(json, "y")};
            break;
        case Kind::mouseButton:
            event.button = readButton(json);
            event.pressed = json.at("pressed").get<bool>();
            event.modifiers = readModifiers(json);
            break;
        case Kind::wheel:
            event.wheel = readFinite(json, "notches");
            break;
        case Kind::key:
            event.key = readKey(json);
            event.pressed = json.at("pressed").get<bool>();
            event.repeated = json.value("repeated", false);
            event.modifiers = readModifiers(json);
            break;
        case Kind::text:
            event.codepoint = json.at("codepoint").get<std::uint32_t>();
            break;
        case Kind::drop:
            event.files = json.at("files").get<std::vector<std::string>>();
            break;
        case Kind::resize:
            event.size = readSize(json.at("size"));
            break;
        case Kind::focus:
            event.pressed = json.at("gained").get<bool>();
            break;
        case Kind::close:
            break;
    }
}

InputScript::Entry readEntry(const Json& json, int previousFrame) {
    InputScript::Entry entry;
    entry.frame = json.at("frame").get<int>();
    if (entry.frame < previousFrame || entry.frame > InputScript::kMaxFrame) {
        wrong(fmt::format("frame {} is out of order: [{}, {}] is expected", entry.frame, previousFrame,
                          InputScript::kMaxFrame));
    }
    const auto name = json.at("event").get<std::string>();
    const auto* const kind =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& known) { return known.second == name; });
    if (kind == kKinds.end()) wrong(fmt::format("unknown event \"{}\"", name));
    entry.event.kind = kind->first;
    readMembers(json, entry.event);
    return entry;
}

void readHeader(const Json& json, InputScript& script) {
    if (json.value("format", "") != "lutka.input") wrong(R"(a header {"format": "lutka.input", …} is expected)");
    if (json.value("version", 0) != InputScript::kVersion) {
        wrong(fmt::format("version {} is not known, only {}", json.value("version", 0), InputScript::kVersion));
    }
    if (json.contains("size")) script.size = readSize(json.at("size"));
}

std::string headerLine(render::Extent size) {
    const Json header = {
        {"format", "lutka.input"}, {"version", InputScript::kVersion}, {"size", {size.width, size.height}}};
    return header.dump() + '\n';
}

std::string entryLine(const InputScript::Entry& entry) {
    return toJson(entry).dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string scriptToText(const InputScript& script) {
    std::string text = headerLine(script.size);
    for (const InputScript::Entry& entry : script.entries)
        text += entryLine(entry);
    return text;
}

Result<InputScript> scriptFromText(std::string_view text, std::string_view source) {
    InputScript script;
    int line = 0;
    bool header = false;
    const auto fail = [&](std::string what) -> Error {
        return {ErrorCode::input, std::move(what), fmt::format("{}:{}", source, line),
                "docs/editor.md tells the format"};
    };
    while (!text.empty()) {
        ++line;
        const std::size_t end = text.find('\n');
        const std::string_view row = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        try {
            const Json json = Json::parse(row);
            if (!header) {
                readHeader(json, script);
                header = true;
            } else {
                script.entries.push_back(readEntry(json, std::max(script.lastFrame(), 0)));
            }
        } catch (const Json::exception& broken) {
            return fail(broken.what());
        } catch (const std::string& what) {
            return fail(what);
        }
    }
    if (!header) return fail("is empty");
    return script;
}

Result<void> saveScript(const std::filesystem::path& file, const InputScript& script) {
    return writeFileAtomically(file, scriptToText(script));
}

Result<InputScript> loadScript(const std::filesystem::path& file) {
    constexpr std::size_t maxBytes = std::size_t{256} << 20U;
    const auto bytes = readFile(file, maxBytes);
    if (!bytes) return bytes.error();
    const auto& data = bytes.value();
    return scriptFromText({reinterpret_cast<const char*>(data.data()), data.size()}, file.string());
}

Result<ScriptWriter> ScriptWriter::create(const std::filesystem::path& file, render::Extent size) {
    ScriptWriter writer(file, std::ofstream(file, std::ios::binary | std::ios::trunc));
    if (auto written = writer.write(headerLine(size)); !written) return written.error();
    return writer;
}

Result<void> ScriptWriter::add(std::span<const InputScript::Entry> entries) {
    if (entries.empty()) return {};
    std::string text;
    for (const InputScript::Entry& entry : entries)
        text += entryLine(entry);
    return write(text);
}

Result<void> ScriptWriter::write(const std::string& text) {
    stream_ << text << std::flush;
    if (stream_.good()) return {};
    return Error{ErrorCode::output, "cannot be written", file_.string(), "choose another place for the recording"};
}

std::span<const InputScript::Entry> ScriptPlayer::take(int frame) {
    const std::size_t first = next_;
    while (next_ < script_.entries.size() && script_.entries[next_].frame <= frame)
        ++next_;
    return std::span(script_.entries).subspan(first, next_ - first);
}

}  // namespace lutka::editor
