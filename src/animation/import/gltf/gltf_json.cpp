#include "animation/import/gltf/gltf_json.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lutka::animation::rig_import::gltf {

using nlohmann::json;

const json* member(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

const json* arrayOf(const json& object, const char* key) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_array()) throw Damage{fmt::format("\"{}\" is no array", key)};
    return value;
}

std::size_t countOf(const json& object, const char* key) {
    const json* array = arrayOf(object, key);
    return array == nullptr ? 0 : array->size();
}

std::optional<int> indexOf(const json& object, const char* key, std::size_t count) {
    const json* value = member(object, key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number_unsigned() || value->get<std::size_t>() >= count)
        throw Damage{fmt::format("\"{}\" names number {}, of which there are {}", key, value->dump(), count)};
    return value->get<int>();
}

std::size_t sizeOf(const json& object, const char* key, std::size_t otherwise) {
    const json* value = member(object, key);
    if (value == nullptr) return otherwise;
    constexpr double kMost = 1e15;  // far beyond any file, and exact
    if (!value->is_number() || value->get<double>() < 0.0 || value->get<double>() > kMost)
        throw Damage{fmt::format("\"{}\" is {}, which is no size", key, value->dump())};
    return static_cast<std::size_t>(value->get<double>());
}

double numberOf(const json& object, const char* key, double otherwise) {
    const json* value = member(object, key);
    if (value == nullptr || !value->is_number()) return otherwise;
    const double number = value->get<double>();
    return std::isfinite(number) ? number : otherwise;
}

std::optional<std::vector<double>> numbersOf(const json& object, const char* key, std::size_t count) {
    const json* value = member(object, key);
    if (value == nullptr || !value->is_array() || value->size() != count) return std::nullopt;
    std::vector<double> numbers;
    for (const json& entry : *value) {
        if (!entry.is_number() || !std::isfinite(entry.get<double>())) return std::nullopt;
        numbers.push_back(entry.get<double>());
    }
    return numbers;
}

std::vector<int> indicesOf(const nlohmann::json& object, const char* key, std::size_t count) {
    std::vector<int> indices;
    const nlohmann::json* array = arrayOf(object, key);
    if (array == nullptr) return indices;
    for (const nlohmann::json& entry : *array) {
        if (!entry.is_number_unsigned() || entry.get<std::size_t>() >= count)
            throw Damage{fmt::format("\"{}\" names node {}, of which there are {}", key, entry.dump(), count)};
        indices.push_back(entry.get<int>());
    }
    return indices;
}

std::string textOf(const json& object, const char* key) {
    const json* value = member(object, key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

bool truthOf(const json& object, const char* key, bool otherwise) {
    const json* value = member(object, key);
    return value != nullptr && value->is_boolean() ? value->get<bool>() : otherwise;
}

const json* extensionOf(const json& object, const char* name) {
    const json* extensions = member(object, "extensions");
    return extensions == nullptr ? nullptr : member(*extensions, name);
}

}  // namespace lutka::animation::rig_import::gltf
