#include "io/json_object.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

namespace render {
namespace {

using Json = nlohmann::json;

const Json empty_object = Json::object();
const Json empty_array = Json::array();

/// Of a number that a float can hold; NaN else.
double finite(const Json& value) {
    const double number = value.is_number() ? value.get<double>() : NAN;
    return std::isfinite(static_cast<float>(number)) ? number : NAN;
}

/// A whole number, which JSON may write as 3 or as 3.0.
std::optional<std::size_t> whole(const Json& value) {
    constexpr double most = 0x1p53;
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (!(number >= 0.0 && number <= most && number == std::floor(number))) return std::nullopt;
    return static_cast<std::size_t>(number);
}

}  // namespace

JsonObject::JsonObject(const Json& json, std::string name) : json_(&json), name_(std::move(name)) {
    if (!json.is_object()) throw lightcuts::invalid_input(name_ + " is not an object; correct it");
}

void JsonObject::fail(const std::string& problem) const { throw lightcuts::invalid_input(name_ + ": " + problem); }

void JsonObject::refuse(const char* key, const std::string& wanted) const {
    fail(std::string(key) + " is not " + wanted + "; correct it");
}

const Json* JsonObject::find(const char* key) const {
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

bool JsonObject::has(const char* key) const { return find(key) != nullptr; }

double JsonObject::number(const char* key, double otherwise) const {
    const Json* value = find(key);
    if (!value) return otherwise;
    const double number = finite(*value);
    if (std::isnan(number)) refuse(key, "a number");
    return number;
}

float JsonObject::number_in(const char* key, float otherwise, float low, float high) const {
    const auto value = static_cast<float>(number(key, static_cast<double>(otherwise)));
    if (!(value >= low && value <= high)) {
        const Json low_text = low;
        const Json high_text = high;
        refuse(key, high < std::numeric_limits<float>::max() ? "from " + low_text.dump() + " to " + high_text.dump()
                                                             : "at least " + low_text.dump());
    }
    return value;
}

std::vector<double> JsonObject::numbers(const char* key, std::size_t count) const {
    const Json* value = find(key);
    if (!value) return {};
    const auto refuse_it = [&] {
        constexpr const char* words[] = {"no", "one", "two", "three", "four"};
        refuse(key, "an array of " + (count < 5 ? std::string(words[count]) : std::to_string(count)) + " numbers");
    };
    if (!value->is_array() || value->size() != count) refuse_it();
    std::vector<double> result;
    for (const Json& each : *value) {
        result.push_back(finite(each));
        if (std::isnan(result.back())) refuse_it();
    }
    return result;
}

glm::vec3 JsonObject::color(const char* key, const glm::vec3& otherwise) const {
    const std::vector<double> v = numbers(key, 3);
    if (v.empty()) return otherwise;
    return glm::vec3(glm::dvec3(v[0], v[1], v[2]));
}

bool JsonObject::flag(const char* key, bool otherwise) const {
    const Json* value = find(key);
    if (!value) return otherwise;
    if (!value->is_boolean()) refuse(key, "true or false");
    return value->get<bool>();
}

std::string JsonObject::text(const char* key, const std::string& otherwise) const {
    const Json* value = find(key);
    if (!value) return otherwise;
    if (!value->is_string()) refuse(key, "a text");
    return value->get<std::string>();
}

std::optional<std::size_t> JsonObject::index(const char* key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    const auto index = whole(*value);
    if (!index) refuse(key, "a whole number of at least 0");
    return index;
}

std::size_t JsonObject::whole_number(const char* key, std::size_t otherwise) const {
    return index(key).value_or(otherwise);
}

std::size_t JsonObject::needed(const char* key) const {
    const auto value = index(key);
    if (!value) fail(std::string("its ") + key + " is missing; the file is damaged");
    return *value;
}

std::vector<std::size_t> JsonObject::indices(const char* key) const {
    std::vector<std::size_t> result;
    for (const Json& value : list(key)) {
        const auto index = whole(value);
        if (!index) refuse(key, "an array of whole numbers of at least 0");
        result.push_back(*index);
    }
    return result;
}

const Json& JsonObject::list(const char* key) const {
    const Json* value = find(key);
    if (!value) return empty_array;
    if (!value->is_array()) refuse(key, "an array");
    return *value;
}

JsonObject JsonObject::object(const char* key) const {
    const Json* value = find(key);
    if (value && !value->is_object()) refuse(key, "an object");
    return {value ? *value : empty_object, name_ + ": " + key};
}

std::optional<JsonObject> JsonObject::extension(const char* key) const {
    const Json* value = object("extensions").find(key);
    if (!value) return std::nullopt;
    if (!value->is_object()) refuse(key, "an object");
    return JsonObject(*value, name_);
}

}  // namespace render
