#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "option_value.hpp"
#include "options.hpp"
#include "rays/ray_tracer.hpp"

namespace render {

/// Declares options of a command whose values are read as the renderer's are: what cannot be obeyed is refused in one
/// line that names the option. Values that are set have to live until the command line has been read.
class OptionDeclaration {
public:
    explicit OptionDeclaration(CLI::App& app) : app_(app) {}

    CLI::Option* text(const std::string& names, const std::string& type, const std::string& help,
                      std::function<void(const std::string&)> set) {
        return app_.add_option_function<std::string>(names, std::move(set), help)->type_name(type);
    }
    template <class Number>
    void number(const std::string& name, const std::string& type, const std::string& help, Number lowest,
                Number highest, const std::string& wanted, Number& value) {
        text(name, type, help,
             [=, &value](const std::string& s) { value = number_in<Number>(name, s, lowest, highest, wanted); });
    }
    CLI::Option* file(const std::string& names, const std::string& help, std::filesystem::path& path) {
        const std::size_t begin = names.find("--");
        const std::string name = begin == std::string::npos ? names : names.substr(begin);
        return text(names, "FILE", help, [name, &path](const std::string& s) {
            if (!std::filesystem::path(s).has_filename()) refuse(name, "'" + s + "'", "a file name");
            path = s;
        });
    }
    /// One of `words`.
    void choice(const std::string& name, const std::string& type, const std::string& help,
                const std::vector<std::string>& words, std::string& value) {
        text(name, type, help, [name, words, &value](const std::string& s) {
            if (std::find(words.begin(), words.end(), s) == words.end()) refuse(name, s, "one of " + listed(words));
            value = s;
        });
    }
    void threads(int& value) {
        number("--threads", "N", "threads (all)", 1, 4096, "a whole number from 1 to 4096", value);
    }
    /// Of the ray tracer.
    void isa(const std::string& help, std::string& value) { choice("--isa", "NAME", help, isa_names(), value); }

private:
    CLI::App& app_;
};

}  // namespace render
