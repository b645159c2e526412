#include "core/json/json_text.hpp"

#include <charconv>
#include <functional>
#include <set>

namespace lutka {
namespace {

using Json = nlohmann::ordered_json;

bool isFlat(const Json& json) {
    for (const Json& item : json)
        if (item.is_structured()) return false;
    return true;
}

// Like dump(2), with arrays of plain values on one line: a change of one number is a change of one line.
void write(const Json& json, int depth, std::string& out) {
    constexpr auto kReplace = Json::error_handler_t::replace;
    if (!json.is_structured() || json.empty()) {
        out += json.dump(-1, ' ', false, kReplace);
        return;
    }
    if (json.is_array() && isFlat(json)) {
        out += '[';
        for (std::size_t i = 0; i < json.size(); ++i)
            out += (i > 0 ? ", " : "") + json[i].dump(-1, ' ', false, kReplace);
        out += ']';
        return;
    }
    const std::string indent(static_cast<std::size_t>(2 * (depth + 1)), ' ');
    out += json.is_object() ? '{' : '[';
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        out += (first ? "\n" : ",\n") + indent;
        if (json.is_object()) out += Json(key).dump(-1, ' ', false, kReplace) + ": ";
        write(value, depth + 1, out);
        first = false;
    }
    out += '\n' + std::string(static_cast<std::size_t>(2 * depth), ' ') + (json.is_object() ? '}' : ']');
}

// Notes keys that an object has twice, of which a parser silently keeps one.
class DuplicateKeys {
  public:
    bool operator()(int /*depth*/, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        if (event == nlohmann::json::parse_event_t::object_start) open_.emplace_back();
        if (event == nlohmann::json::parse_event_t::object_end) open_.pop_back();
        if (event == nlohmann::json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second) {
            found.push_back("the key \"" + parsed.get<std::string>() + "\" stands twice in one object");
        }
        return true;
    }
    std::vector<std::string> found;

  private:
    std::vector<std::set<std::string>> open_;
};

}  // namespace

Json jsonNumber(float value) {
    if (value == 0.0F) return 0.0;  // no sign
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double wide = 0.0;
    std::from_chars(text, end, wide);
    return wide;
}

Json jsonVector(const vec3& v) {
    return Json::array({jsonNumber(v.x), jsonNumber(v.y), jsonNumber(v.z)});
}

Json jsonQuaternion(const quat& q) {
    return Json::array({jsonNumber(q.x), jsonNumber(q.y), jsonNumber(q.z), jsonNumber(q.w)});
}

Result<nlohmann::json> parseJson(std::string_view text, std::string_view source,
                                 std::vector<std::string>& duplicateKeys) {
    DuplicateKeys duplicates;
    try {
        auto document = nlohmann::json::parse(text, std::ref(duplicates));
        duplicateKeys = std::move(duplicates.found);
        return document;
    } catch (const nlohmann::json::exception& failure) {
        return Error{ErrorCode::input, std::string("not JSON: ") + failure.what(), std::string(source), {}};
    }
}

std::string jsonText(const Json& json) {
    std::string out;
    write(json, 0, out);
    return out + '\n';
}

}  // namespace lutka
