#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "bindings/conversions.hpp"
#include "bindings/errors.hpp"
#include "scene/asset/load_words.hpp"

namespace lutka::python {

/// The keyword arguments of a call with many of them. Each is taken once, then finish() refuses what is left.
class Keywords {
  public:
    /// `call`: the function's name in messages.
    Keywords(std::string call, py::kwargs given) : call_(std::move(call)), given_(std::move(given)) {}

    /// Sets `value` where the keyword was given and isn't None, and says whether. A TypeError for another type.
    template <class T>
    bool take(const char* name, T& value) {
        known_.emplace_back(name);
        if (!given_.contains(name) || given_[name].is_none()) return false;
        const py::object object = given_[name];
        try {
            value = py::cast<T>(object);
        } catch (const py::cast_error&) {
            throw py::type_error(call_ + "(): " + name + " can't be " + std::string(py::repr(object)));
        }
        return true;
    }
    template <class T>
    bool take(const char* name, std::optional<T>& value) {
        T given{};
        if (!take(name, given)) return false;
        value = std::move(given);
        return true;
    }
    /// A finite number in [low, high]; raises UsageError otherwise.
    template <class T>
    bool take(const char* name, T& value, double low, double high) {
        T given{};
        if (!take(name, given)) return false;
        const auto number = static_cast<double>(given);
        if (!(number >= low && number <= high)) refuse(name, low, high);
        value = given;
        return true;
    }
    template <class T>
    bool take(const char* name, std::optional<T>& value, double low, double high) {
        T given{};
        if (!take(name, given, low, high)) return false;
        value = given;
        return true;
    }
    /// One of the words of scene/asset/load_words.hpp, as what it means; raises UsageError otherwise.
    template <class Words, class T>
    bool takeWord(const char* name, const Words& words, T& value) {
        std::string word;
        if (!take(name, word)) return false;
        const auto meaning = scene::meaningOf(words, word);
        if (!meaning) refuseWord(name, word, scene::wordsOf(words));
        value = *meaning;
        return true;
    }
    [[noreturn]] void refuseWord(const char* name, const std::string& word,
                                 const std::vector<std::string>& words) const;

    /// A TypeError when something was given that was never asked for.
    void finish() const;

  private:
    [[noreturn]] void refuse(const char* name, double low, double high) const;

    std::string call_;
    py::kwargs given_;
    std::vector<std::string> known_;
};

}  // namespace lutka::python
