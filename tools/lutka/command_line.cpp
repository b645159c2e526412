#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "core/result.hpp"
#include "misspelling.hpp"
#include "terminal_text.hpp"

namespace lutka::cli {

Option Option::required(bool yes) const {
    option_->required(yes);
    return *this;
}

Option Option::describe(const std::string& help) const {
    option_->description(help);
    return *this;
}

Option Option::range(int low, int high) const {
    option_->check(CLI::Range(low, high));
    return *this;
}

// CLI11's own range lets NaN through.
Option Option::range(double low, double high) const {
    const std::string range = fmt::format("number in [{}, {}]", low, high);
    option_->check(CLI::Validator(
        [low, high, range](std::string& text) -> std::string {
            double value = 0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return number && value >= low && value <= high ? "" : fmt::format("'{}' is no {}", text, range);
        },
        range));
    return *this;
}

Option Option::oneOf(const std::vector<std::string>& words, bool ignoreCase) const {
    ignoreCase ? option_->check(CLI::IsMember(words, CLI::ignore_case)) : option_->check(CLI::IsMember(words));
    return *this;
}

Option Option::check(std::function<std::string(const std::string&)> problem) const {
    option_->check(CLI::Validator([problem = std::move(problem)](std::string& text) { return problem(text); }, ""));
    return *this;
}

Option Option::commaSeparated(int count) const {
    option_->delimiter(',');
    option_->transform(CLI::Validator(
        [](std::string& piece) {
            piece = CLI::detail::trim_copy(piece);
            return std::string();
        },
        ""));
    if (count > 0)
        option_->expected(count);
    else
        option_->allow_extra_args(false);  // what follows the word is no part of the list
    return *this;
}

Option Option::oneValueEach() const {
    option_->allow_extra_args(false);
    return *this;
}

Option Option::needs(const Option& other) const {
    option_->needs(other.option_);
    return *this;
}

Option Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

Option Option::showDefault() const {
    option_->capture_default_str();
    return *this;
}

Command Command::add(const std::string& name, const std::string& help) const {
    return Command(app_->add_subcommand(name, help));
}

template <class T>
Option Command::option(const std::string& names, T& value, const std::string& help) const {
    CLI::Option* option = app_->add_option(names, value, help);
    // No value of ours is empty. A script whose variable isn't set must not pass for a run without the option.
    option->check(CLI::Validator(
        [](std::string& text) { return text.empty() ? "empty (is a variable of a script not set?)" : std::string(); },
        ""));
    return Option(option);
}

template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::filesystem::path&, const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, float&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::filesystem::path>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<float>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::uint64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<float>&, const std::string&) const;

Option Command::flag(const std::string& names, bool& value, const std::string& help) const {
    return Option(app_->add_flag(names, value, help));
}

Option Command::find(const std::string& name) const {
    return Option(app_->get_option(name));
}

void Command::onRun(std::function<void()> run) const {
    app_->callback(std::move(run));
}

namespace {

std::string guess(const std::string& given, const std::vector<std::string>& words) {
    const std::string meant = likelyMeant(given, words);
    return meant.empty() ? std::string() : fmt::format(" (did you mean {}?)", meant);
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    }
    return names;
}

// What stands after the mark `--`: words, whatever they begin with.
std::vector<std::string> afterMark(int argc, char** argv) {
    char** const end = argv + argc;
    char** const mark = std::find(argv, end, std::string_view("--"));
    return mark == end ? std::vector<std::string>() : std::vector<std::string>(mark + 1, end);
}

// The arguments that nothing has taken, options without their values.
struct LeftOver {
    std::vector<std::string> options;
    std::vector<std::string> words;
};

LeftOver leftOver(const CLI::App& app, const std::vector<std::string>& plain) {
    std::vector<std::string> all = app.remaining();
    for (const CLI::App* command : app.get_subcommands()) {
        const std::vector<std::string> ofCommand = command->remaining();
        all.insert(all.end(), ofCommand.begin(), ofCommand.end());
    }
    std::erase(all, "--");  // the parser keeps the mark where it needed none
    LeftOver left;
    for (const std::string& one : all) {
        const bool option = one.starts_with('-') && std::find(plain.begin(), plain.end(), one) == plain.end();
        option ? left.options.push_back(one.substr(0, one.find('='))) : left.words.push_back(one);
    }
    return left;
}

// The argument that is misspelled, as a sentence for the user; empty if none is. CLI11's own message does not always
// name it. `misses`: CLI11 says that an option is missing, which may be the misspelled one.
std::string misspelled(const CLI::App& app, const std::vector<std::string>& plain, bool misses) {
    const std::vector<CLI::App*> given = app.get_subcommands();
    const LeftOver left = leftOver(app, plain);
    if (given.empty()) {
        if (left.words.empty()) return {};
        const std::string& word = left.words.front();
        return fmt::format("There is no command '{}'{}", word, guess(word, commandNames(app)));
    }
    const std::string command = given.front()->get_name();
    if (!left.options.empty()) {
        std::vector<std::string> names = optionNames(*given.front());
        const std::vector<std::string> common = optionNames(app);
        names.insert(names.end(), common.begin(), common.end());
        const std::string& name = left.options.front();
        return fmt::format("lutka {} has no option {}{}", command, name, guess(name, names));
    }
    return misses || left.words.empty() ? std::string()
                                        : fmt::format("lutka {} takes no '{}'", command, left.words.front());
}

}  // namespace

int parseCommandLine(int argc, char** argv, const ProgramFacts& facts,
                     const std::function<void(const Command&)>& addCommands) {
    CLI::App app("Lutka turns any rigged character into a physically sound ragdoll.", "lutka");
    app.set_version_flag("--version", facts.version);
    // Like the version flag: what is thrown is printed, and nothing else is asked for.
    app.add_flag_callback(
        "--licenses", [&facts] { throw CLI::CallForVersion(facts.licenses, 0); },
        "Print what the program is made of, with versions and licences, and exit");
    // These stand before or after the command.
    app.fallthrough();
    CLI::Option* quiet =
        app.add_flag_callback("-q,--quiet", facts.onQuiet, "Tell nothing but errors, and what --json or -o - asks for");
    app.add_flag_callback("-v,--verbose", facts.onVerbose, "Tell what is done and how long it takes")->excludes(quiet);
    app.footer(facts.footer);
    app.require_subcommand(1);
    const std::vector<std::string> plain = afterMark(argc, argv);
    app.failure_message([&plain](const CLI::App* program, const CLI::Error& wrong) {
        const auto is = [&](CLI::ExitCodes code) { return wrong.get_exit_code() == static_cast<int>(code); };
        const bool misses = is(CLI::ExitCodes::RequiredError) || is(CLI::ExitCodes::RequiresError);
        const bool isSpelling = is(CLI::ExitCodes::ExtrasError) || misses || program->get_subcommands().empty();
        const std::string ours = isSpelling ? misspelled(*program, plain, misses) : std::string();
        const CLI::Error told(wrong.get_name(), fitForTerminal(ours.empty() ? wrong.what() : ours),
                              wrong.get_exit_code());
        return CLI::FailureMessage::simple(program, told);
    });
    addCommands(Command(&app));
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return app.exit(asked);
    } catch (const CLI::ParseError& wrong) {
        app.exit(wrong);
        return static_cast<int>(ErrorCode::usage);
    }
    return 0;
}

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> pieces;
    for (const std::string& piece : CLI::detail::split(text, ','))
        pieces.push_back(CLI::detail::trim_copy(piece));
    return pieces;
}

}  // namespace lutka::cli
