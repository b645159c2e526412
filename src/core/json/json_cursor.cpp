#include "core/json/json_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/json/json_text.hpp"

namespace lutka {
JsonCursor JsonCursor::operator[](const char* key) const {
    const bool there = has(key);
    return {there ? &(*value_)[key] : nullptr, pointer_ + '/' + jsonPointerStep(key), problems_};
}

JsonCursor JsonCursor::operator[](std::size_t index) const {
    const bool there = value_ != nullptr && value_->is_array() && index < value_->size();
    return {there ? &(*value_)[index] : nullptr, fmt::format("{}/{}", pointer_, index), problems_};
}

bool JsonCursor::has(const char* key) const {
    return value_ != nullptr && value_->is_object() && value_->contains(key);
}

void JsonCursor::report(const std::string& expectation) const {
    problems_->push_back((pointer_.empty() ? "/" : pointer_) + ": " + expectation);
    failed_ = true;
}

void JsonCursor::wrongType(const char* expectation) const {
    failed_ = true;
    if (value_ != nullptr) report(fmt::format("expected {}, got {}", expectation, value_->type_name()));
}

void JsonCursor::expectObject(std::initializer_list<const char*> required,
                              std::initializer_list<const char*> optional) const {
    if (value_ == nullptr || !value_->is_object()) {
        wrongType("an object");
        return;
    }
    for (const char* key : required) {
        if (!value_->contains(key)) report(fmt::format("expected a member \"{}\", there is none", key));
    }
    for (const auto& [key, value] : value_->items()) {
        const auto isKey = [&name = key](const char* known) { return name == known; };
        if (std::none_of(required.begin(), required.end(), isKey) &&
            std::none_of(optional.begin(), optional.end(), isKey)) {
            std::vector<const char*> known(required);
            known.insert(known.end(), optional.begin(), optional.end());
            problems_->push_back(pointer_ + '/' + jsonPointerStep(key) + ": unknown key, expected one of " +
                                 fmt::format("{}", fmt::join(known, ", ")));
        }
    }
}

bool JsonCursor::expectArray(int fewest, int most) const {
    if (value_ == nullptr || !value_->is_array()) {
        wrongType("an array");
        return false;
    }
    const auto size = static_cast<long long>(value_->size());
    if (size >= fewest && size <= most) return true;
    report(fewest == most ? fmt::format("expected {} items, got {}", fewest, size)
                          : fmt::format("expected {} to {} items, got {}", fewest, most, size));
    return false;
}

float JsonCursor::number(float low, float high) const {
    const float harmless = std::clamp(0.0F, low, high);
    if (value_ == nullptr || !value_->is_number()) {
        wrongType("a number");
        return harmless;
    }
    // Compared as a double: one beyond a float's range has no defined value as a float.
    const auto value = value_->get<double>();
    if (std::isfinite(value) && value >= static_cast<double>(low) && value <= static_cast<double>(high))
        return static_cast<float>(value);
    report(fmt::format("expected a finite number in [{}, {}], got {}", low, high,
                       value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
    return harmless;
}

std::vector<float> JsonCursor::numbers(std::size_t count, float low, float high) const {
    std::vector<float> values(count, std::clamp(0.0F, low, high));
    if (!expectArray(static_cast<int>(count), static_cast<int>(count))) return values;
    for (std::size_t i = 0; i < count; ++i) {
        const JsonCursor item = (*this)[i];
        values[i] = item.number(low, high);
        failed_ = failed_ || !item.readable();
    }
    return values;
}

std::optional<long long> JsonCursor::wholeNumber() const {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<long long>::max());
    const bool tooLarge = value_ != nullptr && value_->is_number_unsigned() && value_->get<std::uint64_t>() > most;
    if (value_ != nullptr && value_->is_number_integer() && !tooLarge) return value_->get<long long>();
    if (value_ == nullptr) {
        report("expected a whole number, there is none");
    } else if (value_->is_number()) {
        report("expected a whole number, got " + value_->dump());
    } else {
        wrongType("a whole number");
    }
    return std::nullopt;
}

std::optional<long long> JsonCursor::wholeNumber(long long low, long long high) const {
    const std::optional<long long> value = wholeNumber();
    if (!value || (*value >= low && *value <= high)) return value;
    report(fmt::format("expected a whole number in [{}, {}], got {}", low, high, *value));
    return std::nullopt;
}

std::string JsonCursor::text() const {
    if (value_ != nullptr && value_->is_string()) return value_->get<std::string>();
    wrongType("a text");
    return {};
}

std::optional<bool> JsonCursor::truth() const {
    if (value_ != nullptr && value_->is_boolean()) return value_->get<bool>();
    wrongType("true or false");
    return std::nullopt;
}

int JsonCursor::oneOf(std::span<const char* const> choices) const {
    if (value_ == nullptr || !value_->is_string()) {
        wrongType("a text");
        return -1;
    }
    const auto value = value_->get<std::string>();
    int index = 0;
    for (const char* choice : choices) {
        if (value == choice) return index;
        ++index;
    }
    report(fmt::format("expected one of \"{}\", got \"{}\"", fmt::join(choices, "\", \""), value));
    return -1;
}

std::vector<std::string> checkFormat(const nlohmann::json& document, const char* format, int version, int oldest) {
    std::vector<std::string> problems;
    const JsonCursor at(document, problems);
    if (!document.is_object()) {
        at.report("expected an object");
        return problems;
    }
    if (!at.has("format")) at.report(fmt::format("expected a member \"format\": \"{}\"", format));
    at["format"].oneOf({format});
    const JsonCursor found = at["version"];
    const auto number = found.wholeNumber();
    const bool upgraded = number && oldest > 0 && *number >= oldest && *number < version;
    if (number && *number != version && !upgraded) {
        found.report(fmt::format(
            "expected version {}, got {}: {}", version, *number,
            *number > version ? "the file is from a newer program" : "there has never been such a version"));
    }
    return problems;
}

Error refusedDocument(const JsonDocumentKind& kind, std::string_view source, std::span<const std::string> problems) {
    constexpr std::size_t kMostTold = 50;
    std::string message =
        fmt::format("not a valid {}, {} problem{}:", kind.name, problems.size(), problems.size() == 1 ? "" : "s");
    for (const std::string& problem : problems.first(std::min(problems.size(), kMostTold)))
        message += "\n  " + problem;
    if (problems.size() > kMostTold) message += fmt::format("\n  and {} more", problems.size() - kMostTold);
    return {ErrorCode::input, std::move(message), std::string(source), std::string(kind.mend)};
}

}  // namespace lutka
