#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "animation/import/import_character.hpp"
#include "core/result.hpp"
#include "physics/fit/fit_options.hpp"

/// The words by which a person names the choices of LoadOptions: on the command line, in a batch's list, in Python.
namespace lutka::scene {

template <class T>
struct Word {
    std::string_view word;
    T meaning;
};

inline constexpr std::array<Word<animation::UpAxis>, 9> kUpAxisWords{{{"x", animation::UpAxis::positiveX},
                                                                      {"y", animation::UpAxis::positiveY},
                                                                      {"z", animation::UpAxis::positiveZ},
                                                                      {"+x", animation::UpAxis::positiveX},
                                                                      {"+y", animation::UpAxis::positiveY},
                                                                      {"+z", animation::UpAxis::positiveZ},
                                                                      {"-x", animation::UpAxis::negativeX},
                                                                      {"-y", animation::UpAxis::negativeY},
                                                                      {"-z", animation::UpAxis::negativeZ}}};
inline constexpr std::array<Word<physics::MassTable>, 3> kMassTableWords{
    {{"de-leva-male", physics::MassTable::deLevaMale},
     {"de-leva-female", physics::MassTable::deLevaFemale},
     {"winter", physics::MassTable::winter}}};
inline constexpr std::array<Word<physics::MassPreset>, 4> kMassPresetWords{
    {{"anatomical", physics::MassPreset::anatomical},
     {"balanced", physics::MassPreset::balanced},
     {"uniform", physics::MassPreset::uniform},
     {"volume", physics::MassPreset::volume}}};
inline constexpr std::array<Word<physics::RigKind>, 2> kRigWords{
    {{"humanoid", physics::RigKind::humanoid}, {"any", physics::RigKind::any}}};

/// What the word means; unset when it is none of them.
template <class Words>
[[nodiscard]] constexpr auto meaningOf(const Words& words, std::string_view word)
    -> std::optional<decltype(words[0].meaning)> {
    for (const auto& entry : words)
        if (entry.word == word) return entry.meaning;
    return std::nullopt;
}

/// All the words, in their order.
template <class Words>
[[nodiscard]] std::vector<std::string> wordsOf(const Words& words) {
    std::vector<std::string> list;
    list.reserve(words.size());
    for (const auto& entry : words)
        list.emplace_back(entry.word);
    return list;
}

/// The preset of that name (physics::presetInfos()); unset when there is none.
[[nodiscard]] std::optional<physics::RagdollPreset> presetNamed(std::string_view name);

/// Adds bodies beside a humanoid's 16: shoulders, neck, toes, trunk, a kind of appendage, or `appendages` for all of
/// these. Fails with ErrorCode::usage for any other word; an empty one adds nothing.
[[nodiscard]] Result<void> addExtraBodies(std::string_view word, physics::FitOptions& fit);

}  // namespace lutka::scene
