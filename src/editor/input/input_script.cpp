#include "editor/input/input_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"

namespace lutka::editor {
namespace {

using Json = nlohmann::ordered_json;
using EventKind = InputEvent::Kind;

constexpr std::array<std::pair<EventKind, std::string_view>, 9> kEventNames = {{
    {EventKind::mouseMove, "mouseMove"},
    {EventKind::mouseButton, "mouseButton"},
    {EventKind::wheel, "wheel"},
    {EventKind::key, "key"},
    {EventKind::text, "text"},
    {EventKind::drop, "drop"},
    {EventKind::resize, "resize"},
    {EventKind::focus, "focus"},
    {EventKind::close, "close"},
}};
constexpr std::array<std::string_view, kMouseButtonCount> kButtons = {"left", "right", "middle"};
constexpr int kMaxWindowSide = 16384;

std::string_view kindName(EventKind kind) {
    return kEventNames[static_cast<std::size_t>(kind)].second;
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
        case EventKind::mouseMove:
            json["x"] = event.position.x;
            json["y"] = event.position.y;
            break;
        case EventKind::mouseButton:
            json["button"] = kButtons[static_cast<std::size_t>(event.button)];
            json["pressed"] = event.pressed;
            writeModifiers(json, event.modifiers);
            break;
        case EventKind::wheel:
            json["notches"] = event.wheel;
            break;
        case EventKind::key:
            json["key"] = keyName(event.key);
            json["pressed"] = event.pressed;
            if (event.repeated) json["repeated"] = true;
            writeModifiers(json, event.modifiers);
            break;
        case EventKind::text:
            json["codepoint"] = event.codepoint;
            break;
        case EventKind::drop:
            json["files"] = event.files;
            break;
        case EventKind::resize:
            json["size"] = {event.size.width, event.size.height};
            break;
        case EventKind::focus:
            json["gained"] = event.pressed;
            break;
        case EventKind::close:
            break;
    }
    return json;
}

template <std::size_t count>
std::array<const char*, count> namesOf(const std::array<std::string_view, count>& names) {
    std::array<const char*, count> out{};
    std::transform(names.begin(), names.end(), out.begin(), [](std::string_view name) { return name.data(); });
    return out;
}

Modifiers readModifiers(const JsonCursor& at) {
    constexpr int most = 3;
    Modifiers modifiers;
    if (!at.has("modifiers") || !at["modifiers"].expectArray(0, most)) return modifiers;
    for (std::size_t i = 0; i < at["modifiers"].size(); ++i) {
        const int which = at["modifiers"][i].oneOf({"shift", "control", "alt"});
        modifiers.shift = modifiers.shift || which == 0;
        modifiers.control = modifiers.control || which == 1;
        modifiers.alt = modifiers.alt || which == 2;
    }
    return modifiers;
}

render::Extent readSize(const JsonCursor& at, int least = 1) {
    if (!at.expectArray(2, 2)) return {1, 1};
    const auto side = [&](std::size_t index) {
        return static_cast<int>(at[index].wholeNumber(least, kMaxWindowSide).value_or(1));
    };
    return {side(0), side(1)};
}

// Of a window; 0 times 0 is a minimised one's.
render::Extent readResize(const JsonCursor& at) {
    const render::Extent size = readSize(at, 0);
    if ((size.width == 0) != (size.height == 0))
        at[size.width == 0 ? 0 : 1].report("expected a whole number above 0, or both of them 0");
    return size;
}

float readNumber(const JsonCursor& at, const char* key) {
    constexpr float most = 1e6F;  // pixels or notches
    return at[key].number(-most, most);
}

Key readKey(const JsonCursor& at) {
    const std::string name = at.text();
    const auto key = keyFromName(name);
    if (at.readable() && !key) at.report("expected the name of a key, got \"" + name + "\"");
    return key.value_or(Key{});
}

std::vector<std::string> readFiles(const JsonCursor& at) {
    constexpr int most = 1000;
    std::vector<std::string> files;
    if (!at.expectArray(0, most)) return files;
    for (std::size_t i = 0; i < at.size(); ++i)
        files.push_back(at[i].text());
    return files;
}

void readButton(const JsonCursor& at, InputEvent& event) {
    at.expectObject({"frame", "event", "button", "pressed"}, {"modifiers"});
    event.button = static_cast<MouseButton>(std::max(0, at["button"].oneOf(namesOf(kButtons))));
    event.pressed = at["pressed"].truth().value_or(false);
    event.modifiers = readModifiers(at);
}

void readKeyEvent(const JsonCursor& at, InputEvent& event) {
    at.expectObject({"frame", "event", "key", "pressed"}, {"repeated", "modifiers"});
    event.key = readKey(at["key"]);
    event.pressed = at["pressed"].truth().value_or(false);
    event.repeated = at.has("repeated") && at["repeated"].truth().value_or(false);
    event.modifiers = readModifiers(at);
}

void readMembers(const JsonCursor& at, InputEvent& event) {
    constexpr long long lastCodepoint = 0x10FFFF;
    switch (event.kind) {
        case EventKind::mouseMove:
            at.expectObject({"frame", "event", "x", "y"});
            event.position = {readNumber(at, "x"), readNumber(at, "y")};
            break;
        case EventKind::mouseButton:
            readButton(at, event);
            break;
        case EventKind::wheel:
            at.expectObject({"frame", "event", "notches"});
            event.wheel = readNumber(at, "notches");
            break;
        case EventKind::key:
            readKeyEvent(at, event);
            break;
        case EventKind::text:
            at.expectObject({"frame", "event", "codepoint"});
            event.codepoint = static_cast<std::uint32_t>(at["codepoint"].wholeNumber(0, lastCodepoint).value_or(0));
            break;
        case EventKind::drop:
            at.expectObject({"frame", "event", "files"});
            event.files = readFiles(at["files"]);
            break;
        case EventKind::resize:
            at.expectObject({"frame", "event", "size"});
            event.size = readResize(at["size"]);
            break;
        case EventKind::focus:
            at.expectObject({"frame", "event", "gained"});
            event.pressed = at["gained"].truth().value_or(false);
            break;
        case EventKind::close:
            at.expectObject({"frame", "event"});
            break;
    }
}

InputScript::Entry readEntry(const JsonCursor& at, int previousFrame) {
    InputScript::Entry entry;
    entry.frame = static_cast<int>(at["frame"].wholeNumber(previousFrame, InputScript::kMaxFrame).value_or(0));
    std::array<const char*, kEventNames.size()> names{};
    std::transform(kEventNames.begin(), kEventNames.end(), names.begin(),
                   [](const auto& kind) { return kind.second.data(); });
    if (!at.has("event")) at.report("expected a member \"event\", there is none");
    const int kind = at["event"].oneOf(names);
    if (kind < 0) return entry;
    entry.event.kind = kEventNames[static_cast<std::size_t>(kind)].first;
    readMembers(at, entry.event);
    return entry;
}

void readHeader(const JsonCursor& at, InputScript& script) {
    at.expectObject({"format", "version"}, {"size"});
    if (at.has("size")) script.size = readSize(at["size"]);
}

// One line of the file into the script; what is wrong with it, each with its JSON pointer, else nothing.
std::vector<std::string> readLine(std::string_view row, bool isHeader, InputScript& script) {
    std::vector<std::string> problems;
    const Result<nlohmann::json> parsed = parseJson(row, "", problems);
    if (!parsed) return {parsed.error().message};
    const JsonCursor at(parsed.value(), problems);
    if (isHeader) {
        std::vector<std::string> header = checkFormat(parsed.value(), "lutka.input", InputScript::kVersion);
        if (!header.empty()) return header;
        readHeader(at, script);
        return problems;
    }
    if (!parsed.value().is_object()) return {"/: expected an object"};
    script.entries.push_back(readEntry(at, std::max(script.lastFrame(), 0)));
    return problems;
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
        const std::vector<std::string> problems = readLine(row, !header, script);
        if (!problems.empty()) return fail(fmt::format("{}", fmt::join(problems, "; ")));
        header = true;
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
    const std::filesystem::path place = isStandardOutput(file) ? "/dev/stdout" : file;
    ScriptWriter writer(file, std::ofstream(place, std::ios::binary | std::ios::trunc));
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
