#include "figures.hpp"

#include <cstdio>
#include <exception>
#include <fstream>

#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/output_file.hpp"

namespace benchmark {

int write_figures(const std::string& program, const std::filesystem::path& file,
                  const std::function<nlohmann::json()>& measure) {
    try {
        render::require_writable(file);
        const std::string figures = measure().dump(2) + "\n";
        render::OutputFile output(file);
        std::ofstream text(output.path(), std::ios::binary);
        text << figures;
        text.close();
        if (!text) throw lightcuts::invalid_input(file.string() + ": cannot be written; is the disk full?");
        output.commit();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", program.c_str(), render::one_line(e.what()).c_str());
        return 1;
    }
}

CLI::Validator odd_number() {
    return CLI::Validator(
        [](const std::string& text) {
            int number = 0;
            const bool odd = CLI::detail::lexical_cast(text, number) && number > 0 && number % 2 == 1;
            return odd ? std::string() : text + " is not an odd number above 0";
        },
        "ODD");
}

}  // namespace benchmark
