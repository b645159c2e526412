#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lutka::animation::rig_import::gltf {

/// What is wrong with a glTF file and what to do about it. Thrown inside this folder only: readGltf() makes an Error of
/// it.
struct Damage {
    std::string what;
    std::string mend = "check that the file is whole, or export it again";
};

/// What `act` gives; a Damage that it throws says in which element of the document it is: "skins[2]: …".
template <class Act>
auto within(const char* array, int index, const Act& act) {
    try {
        return act();
    } catch (Damage& damage) {
        damage.what = std::string(array) + "[" + std::to_string(index) + "]: " + damage.what;
        throw;
    }
}

/// The member of an object; null where there is none, where it is JSON's null (as some writers have what they leave
/// out), or where `object` is none.
[[nodiscard]] const nlohmann::json* member(const nlohmann::json& object, const char* key);
/// The member, which must be an array; null where there is none. Throws Damage where it is something else.
[[nodiscard]] const nlohmann::json* arrayOf(const nlohmann::json& object, const char* key);
/// How many elements the array of that name has; 0 where there is none.
[[nodiscard]] std::size_t countOf(const nlohmann::json& object, const char* key);
/// The index that is named, below `count`; nothing where it isn't there. Throws Damage where it is no index or too
/// large.
[[nodiscard]] std::optional<int> indexOf(const nlohmann::json& object, const char* key, std::size_t count);
/// A whole number from 0 up. Throws Damage where it is none.
[[nodiscard]] std::size_t sizeOf(const nlohmann::json& object, const char* key, std::size_t otherwise);
/// A finite number; `otherwise` where there is none or it is not finite.
[[nodiscard]] double numberOf(const nlohmann::json& object, const char* key, double otherwise);
/// So many finite numbers; nothing where there is no such array.
[[nodiscard]] std::optional<std::vector<double>> numbersOf(const nlohmann::json& object, const char* key,
                                                           std::size_t count);
/// Indices below `count`; none where there is no such array. Throws Damage where an entry is no such index.
[[nodiscard]] std::vector<int> indicesOf(const nlohmann::json& object, const char* key, std::size_t count);
[[nodiscard]] std::string textOf(const nlohmann::json& object, const char* key);
[[nodiscard]] bool truthOf(const nlohmann::json& object, const char* key, bool otherwise);
/// The block of an extension; null where there is none.
[[nodiscard]] const nlohmann::json* extensionOf(const nlohmann::json& object, const char* name);

}  // namespace lutka::animation::rig_import::gltf
