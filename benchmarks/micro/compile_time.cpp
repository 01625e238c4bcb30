/// Time of compiling a file that includes the whole library, against one that includes only the standard and GLM
/// headers that the library does. Prints a table and writes compile_time.json.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "timing.hpp"

namespace {

namespace fs = std::filesystem;

/// What a header reaches: the library's own files, and all others by the names in angle brackets.
struct Includes {
    std::set<fs::path> own;
    std::set<std::string> foreign;

    void follow(const fs::path& file) {
        if (!own.insert(fs::weakly_canonical(file)).second) return;
        std::ifstream text(file);
        if (!text) throw std::runtime_error(file.string() + ": cannot be read");
        const std::string directive = "#include ";
        for (std::string line; std::getline(text, line);) {
            if (line.compare(0, directive.size(), directive) != 0) continue;
            const std::size_t begin = directive.size() + 1;
            const std::size_t end = line.find_first_of("\">", begin);
            const std::string name = line.substr(begin, end - begin);
            if (line[begin - 1] == '<') {
                foreign.insert(name);
            } else {
                follow(file.parent_path() / name);
            }
        }
    }
};

/// A folder of its own for files to compile; gone with the object.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("lightcuts-compile-time-" + std::to_string(getpid()))) {
        fs::create_directory(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    /// Writes a source file with `headers` and returns its path.
    template <class Headers>
    fs::path write(const std::string& name, const Headers& headers) const {
        const fs::path file = path_ / (name + ".cpp");
        std::ofstream text(file);
        for (const std::string& header : headers) text << "#include <" << header << ">\n";
        return file;
    }

private:
    fs::path path_;
};

double seconds_of_children() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Processor seconds of the compiler. throws: runtime_error if it fails.
double seconds_to_compile(const fs::path& file) {
    const std::string command = "'" LIGHTCUTS_CXX_COMPILER "' -std=c++20 -fsyntax-only -I'" LIGHTCUTS_INCLUDE_DIRECTORY
                                "' '" +
                                file.string() + "'";
    const double start = seconds_of_children();
    const int status = std::system(command.c_str());
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("failed: " + command);
    return seconds_of_children() - start;
}

nlohmann::json measure(int runs, bool each) {
    const std::string umbrella = "lightcuts/lightcuts.hpp";
    Includes includes;
    includes.follow(fs::path(LIGHTCUTS_INCLUDE_DIRECTORY) / umbrella);

    struct Row {
        std::string name;
        fs::path file;
        std::vector<double> seconds;
    };
    const Folder folder;
    std::vector<Row> rows;
    rows.push_back({"nothing", folder.write("nothing", std::set<std::string>{}), {}});
    rows.push_back({std::to_string(includes.foreign.size()) + " standard and GLM headers",
                    folder.write("foreign", includes.foreign),
                    {}});
    rows.push_back({"<" + umbrella + ">", folder.write("umbrella", std::set<std::string>{umbrella}), {}});
    if (each) {
        for (const std::string& header : includes.foreign) {
            std::string name = header;
            std::replace(name.begin(), name.end(), '/', '_');
            rows.push_back({"  <" + header + ">", folder.write(name, std::set<std::string>{header}), {}});
        }
    }
    for (int i = 0; i < runs; ++i) {
        for (Row& row : rows) row.seconds.push_back(seconds_to_compile(row.file));
    }

    const double foreign = benchmark::median(rows[1].seconds);
    nlohmann::json json = {{"compiler", LIGHTCUTS_CXX_COMPILER}, {"library_headers", includes.own.size()}};
    std::printf("%-36s %9s %9s\n", "includes", "seconds", "/std+GLM");
    for (const Row& row : rows) {
        const double seconds = benchmark::median(row.seconds);
        std::printf("%-36s %9.3f %9.2f\n", row.name.c_str(), seconds, seconds / foreign);
        json["seconds"].push_back({row.name, seconds});
    }
    json["umbrella_over_foreign"] = benchmark::median(rows[2].seconds) / foreign;
    return json;
}

}  // namespace

int main(int argc, char** argv) {
    int runs = 5;
    bool each = false;
    CLI::App app{"Time of compiling a file that includes the whole library"};
    app.add_option("--runs", runs, "medians are over this odd number")->check(benchmark::odd_number());
    app.add_flag("--each", each, "also each of the standard and GLM headers alone");
    CLI11_PARSE(app, argc, argv);
    return benchmark::write_figures("bench-compile_time", "compile_time.json", [&] { return measure(runs, each); });
}
