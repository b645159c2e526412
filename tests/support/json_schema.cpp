#include "support/json_schema.hpp"

#include <algorithm>
#include <set>

namespace lutka::test {
namespace {

using nlohmann::json;

std::string join(const std::string& a, const char* between, const std::string& b) {
    std::string out = a;
    out += between;
    out += b;
    return out;
}

class Checker {
  public:
    explicit Checker(const json& root) : root_(root) {}

    void check(const json& schema, const json& value, const std::string& place, std::vector<std::string>& problems) {
        for (const auto& [keyword, rule] : schema.items()) {
            if (!holds(keyword, rule, schema, value, place, problems)) problems.push_back(join(place, ": ", keyword));
        }
    }

  private:
    bool holds(const std::string& keyword, const json& rule, const json& schema, const json& value,
               const std::string& place, std::vector<std::string>& problems) {
        static const std::set<std::string> kSilent{"$schema", "$id",         "$defs",
                                                   "title",   "description", "additionalProperties"};
        if (kSilent.count(keyword) > 0) return true;
        if (keyword == "type" && rule == "integer") return value.is_number_integer();
        if (keyword == "type") return std::string(value.type_name()) == rule.get<std::string>();
        if (keyword == "const") return value == rule;
        if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
        if (keyword == "minimum") return !value.is_number() || value.get<double>() >= rule.get<double>();
        if (keyword == "maximum") return !value.is_number() || value.get<double>() <= rule.get<double>();
        if (keyword == "exclusiveMinimum") return !value.is_number() || value.get<double>() > rule.get<double>();
        if (keyword == "exclusiveMaximum") return !value.is_number() || value.get<double>() < rule.get<double>();
        if (keyword == "minItems") return value.size() >= rule.get<std::size_t>();
        if (keyword == "maxItems") return value.size() <= rule.get<std::size_t>();
        if (keyword == "required") {
            return std::all_of(rule.begin(), rule.end(),
                               [&](const json& key) { return value.contains(key.get<std::string>()); });
        }
        if (keyword == "properties") return checkMembers(rule, schema, value, place, problems);
        if (keyword == "items") {
            for (std::size_t i = 0; i < value.size(); ++i)
                check(rule, value[i], join(place, "/", std::to_string(i)), problems);
            return true;
        }
        if (keyword == "$ref") {
            check(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, place, problems);
            return true;
        }
        if (keyword == "oneOf") return countMatches(rule, value) == 1;
        return false;
    }

    bool checkMembers(const json& rule, const json& schema, const json& value, const std::string& place,
                      std::vector<std::string>& problems) {
        for (const auto& [key, member] : value.items()) {
            if (rule.contains(key)) {
                check(rule[key], member, join(place, "/", key), problems);
            } else if (schema.value("additionalProperties", true) == false) {
                problems.push_back(join(place, "/", key) += ": unknown");
            }
        }
        return true;
    }

    int countMatches(const json& choices, const json& value) {
        int matches = 0;
        for (const json& choice : choices) {
            std::vector<std::string> problems;
            check(choice, value, "", problems);
            matches += problems.empty() ? 1 : 0;
        }
        return matches;
    }

    const json& root_;
};

}  // namespace

std::vector<std::string> checkSchema(const json& schema, const json& document) {
    std::vector<std::string> problems;
    Checker(schema).check(schema, document, "", problems);
    return problems;
}

}  // namespace lutka::test
