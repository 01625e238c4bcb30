#include "io/outputs.hpp"

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/file_group.hpp"
#include "io/output_file.hpp"

namespace render {

namespace {

bool is_there(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

/// True iff the report `path` says that its picture is not finished.
bool tells_of_interruption(const std::filesystem::path& path) {
    std::ifstream file(path);
    const auto report = nlohmann::json::parse(file, nullptr, false);
    return report.is_object() && report.value("interrupted", nlohmann::json()) == true;
}

std::vector<char> text_bytes(const RunReport& report) {
    const std::string text = to_json(report).dump(2) + "\n";
    return {text.begin(), text.end()};
}

}  // namespace

Outputs::Outputs(const std::filesystem::path& picture)
    : exr(picture), png(beside(picture, ".png")), json(beside(picture, ".json")), resume(beside(picture, ".resume")) {}

Outputs Outputs::of_unfinished() const {
    const bool taken = is_there(exr) || is_there(png) || is_there(json);
    if (!taken || tells_of_interruption(json)) return *this;
    return of_part();
}

Outputs Outputs::of_part() const {
    const std::string extension = exr.extension().string();
    return Outputs(beside(exr, ".partial" + (extension.empty() ? ".exr" : extension)));
}

void Outputs::require_all_writable() const {
    for (const auto& path : {exr, png, json}) require_writable(path);
}

void Outputs::require_no_input(const std::vector<std::filesystem::path>& inputs) const {
    const Outputs part = of_part();
    for (const auto& output : {exr, png, json, part.exr, part.png, part.json}) {
        for (const auto& input : inputs) require_apart(output, input);
    }
}

void save(const Outputs& outputs, const Picture& picture, const RunReport& report) {
    FileGroup files;
    files.add(outputs.exr, [&] { return exr_bytes(picture); });
    files.add(outputs.png, [&] { return png_bytes(picture.width, picture.height, tone_mapped(picture)); });
    files.add(outputs.json, [&] { return text_bytes(report); });
    files.commit();
}

}  // namespace render
