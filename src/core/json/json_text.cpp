#include "core/json/json_text.hpp"

#include <charconv>
#include <cstdint>
#include <utility>

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

// Builds the document as nlohmann's own reader would, and knows at any time where in it the reader is.
class DocumentBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(value); }
    bool number_unsigned(std::uint64_t value) override { return add(value); }
    bool number_float(double value, const std::string& /*text*/) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(nlohmann::json::binary_t& /*value*/) override { return false; }  // not in JSON text
    bool start_object(std::size_t /*size*/) override { return open(nlohmann::json::object()); }
    bool start_array(std::size_t /*size*/) override { return open(nlohmann::json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        Level& level = open_.back();
        level.key = name;
        if (level.container->contains(name))
            duplicates.push_back(pointer() + ": the key \"" + name + "\" stands twice in one object");
        return true;
    }

    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::json::exception& problem) override {
        return fail(std::string("not JSON: ") + problem.what());
    }

    nlohmann::json document;
    std::vector<std::string> duplicates;
    std::string failure;  ///< With the pointer to where it happened; empty when all went well.

  private:
    struct Level {
        nlohmann::json* container;
        std::string key;  ///< Of the member that is being read.
    };

    [[nodiscard]] std::string pointer() const {
        std::string out;
        for (const Level& level : open_) {
            // The item that is being read is an array's last, or its next one where it has not been added yet.
            const std::size_t added = &level == &open_.back() ? 0 : 1;
            const bool isArray = level.container->is_array();
            out += '/' + (isArray ? std::to_string(level.container->size() - added) : jsonPointerStep(level.key));
        }
        return out.empty() ? "/" : out;
    }

    bool fail(const std::string& what) {
        failure = pointer() + ": " + what;
        return false;
    }

    nlohmann::json* place(nlohmann::json value) {
        if (open_.empty()) {
            document = std::move(value);
            return &document;
        }
        nlohmann::json& container = *open_.back().container;
        if (container.is_array()) {
            container.push_back(std::move(value));
            return &container.back();
        }
        return &(container[open_.back().key] = std::move(value));
    }

    template <class T>
    bool add(T value) {
        place(nlohmann::json(std::move(value)));
        return true;
    }

    bool open(nlohmann::json container) {
        if (open_.size() >= kDeepestJson)
            return fail("is nested deeper than " + std::to_string(kDeepestJson) + " levels");
        open_.push_back({place(std::move(container)), {}});
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    std::vector<Level> open_;
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
    DocumentBuilder builder;
    try {
        nlohmann::json::sax_parse(text, &builder);
    } catch (const nlohmann::json::exception& failure) {
        builder.failure = failure.what();
    }
    if (!builder.failure.empty()) return Error{ErrorCode::input, builder.failure, std::string(source), {}};
    duplicateKeys = std::move(builder.duplicates);
    return std::move(builder.document);
}

std::string jsonPointerStep(std::string_view key) {
    std::string out;
    for (const char c : key)
        out += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
    return out;
}

std::string jsonText(const Json& json) {
    std::string out;
    write(json, 0, out);
    return out + '\n';
}

}  // namespace lutka
