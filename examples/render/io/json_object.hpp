#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

namespace render {

/// An object of a JSON file together with the words by which messages name it, such as `node 'door'`. Refers to the
/// file's contents. Every reader throws invalid_input, naming the object and the member, if the member is not of the
/// kind that is asked for.
class JsonObject {
public:
    /// throws: invalid_input with `name` if `json` is no object.
    JsonObject(const nlohmann::json& json, std::string name);

    const std::string& name() const { return name_; }
    [[noreturn]] void fail(const std::string& problem) const;
    /// "NAME: KEY is not WANTED; correct it"
    [[noreturn]] void refuse(const char* key, const std::string& wanted) const;

    bool has(const char* key) const;
    /// The member, or null if there is none.
    const nlohmann::json* find(const char* key) const;

    /// A finite number that fits a float.
    double number(const char* key, double otherwise) const;
    /// Likewise, within [low, high].
    float number_in(const char* key, float otherwise, float low, float high) const;
    /// An array of `count` such numbers; empty if there is none.
    std::vector<double> numbers(const char* key, std::size_t count) const;
    /// An array of three of at least 0.
    glm::vec3 color(const char* key, const glm::vec3& otherwise) const;
    bool flag(const char* key, bool otherwise) const;
    std::string text(const char* key, const std::string& otherwise = {}) const;

    /// A whole number of at least 0.
    std::optional<std::size_t> index(const char* key) const;
    std::size_t whole_number(const char* key, std::size_t otherwise) const;
    /// One that has to be there.
    std::size_t needed(const char* key) const;
    std::vector<std::size_t> indices(const char* key) const;

    /// An array; an empty one if there is none.
    const nlohmann::json& list(const char* key) const;

    /// A member that is an object, by this object's name and `key`; an empty one if there is none.
    JsonObject object(const char* key) const;
    /// The same of `extensions`.`key`, by this object's name alone; empty if there is none.
    std::optional<JsonObject> extension(const char* key) const;

private:
    const nlohmann::json* json_;
    std::string name_;
};

}  // namespace render
