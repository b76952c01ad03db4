// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/toml_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <toml++/toml.h>

namespace support {

struct TomlTable::Node {
    std::shared_ptr<toml::table> root;
    const toml::table* table = nullptr;
    fs::path file;
    std::string prefix; // "camera." for fields of [camera]
    std::set<std::string, std::less<>> read;
    std::vector<std::shared_ptr<Node>> children;
    std::size_t line = 0;

    const toml::node* find(std::string_view key) {
        read.emplace(key);
        return table ? table->get(key) : nullptr;
    }
};

namespace {

const toml::table empty_table;

std::string found(const toml::node& node) {
    std::ostringstream out;
    if (node.is_table()) {
        return "a table";
    }
    if (node.is_array()) {
        return "an array";
    }
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) {
            out << value;
        }
    });
    const std::string text = one_line(out.str());
    return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

} // namespace

TomlTable TomlTable::read(const fs::path& file) {
    const std::string text = read_text(file, std::uintmax_t{4} << 20);
    auto node = std::make_shared<Node>();
    node->file = file;
    try {
        node->root = std::make_shared<toml::table>(toml::parse(text, file.string()));
    } catch (const toml::parse_error& error) {
        throw input_error("{}:{}: expected TOML, found: {}", file.string(), error.source().begin.line,
                          one_line(std::string(error.description())));
    }
    node->table = node->root.get();
    return TomlTable(std::move(node));
}

bool TomlTable::has(std::string_view key) { return node_->find(key) != nullptr; }

InputError TomlTable::error(std::string_view key, std::string_view message) const {
    const toml::node* at = node_->table->get(key);
    const std::size_t line = at ? at->source().begin.line : node_->line;
    return line > 0 ? input_error("{}:{}: {}{}: {}", node_->file.string(), line, node_->prefix, key, message)
                    : input_error("{}: {}{}: {}", node_->file.string(), node_->prefix, key, message);
}

template <typename T>
T TomlTable::required(std::string_view key, std::optional<T> fallback, std::string_view expected) const {
    if (!fallback) {
        throw error(key, fmt::format("expected {}, found nothing", expected));
    }
    return *std::move(fallback);
}

double TomlTable::number(std::string_view key, double least, double most, std::optional<double> fallback) {
    const std::string expected = fmt::format("a number from {} to {}", least, most);
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, fallback, expected);
    }
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < least || *value > most) {
        throw error(key, fmt::format("expected {}, found {}", expected, found(*node)));
    }
    return *value;
}

int TomlTable::integer(std::string_view key, int least, int most, std::optional<int> fallback) {
    const std::string expected = fmt::format("a whole number from {} to {}", least, most);
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, fallback, expected);
    }
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < least || *value > most) {
        throw error(key, fmt::format("expected {}, found {}", expected, found(*node)));
    }
    return static_cast<int>(*value);
}

bool TomlTable::boolean(std::string_view key, std::optional<bool> fallback) {
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, fallback, "true or false");
    }
    if (!node->is_boolean()) {
        throw error(key, fmt::format("expected true or false, found {}", found(*node)));
    }
    return *node->value<bool>();
}

std::string TomlTable::text(std::string_view key, std::optional<std::string> fallback) {
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, std::move(fallback), "a text");
    }
    if (!node->is_string()) {
        throw error(key, fmt::format("expected a text, found {}", found(*node)));
    }
    return *node->value<std::string>();
}

std::string TomlTable::word(std::string_view key, std::initializer_list<std::string_view> words,
                            std::optional<std::string> fallback) {
    const std::string value = text(key, std::move(fallback));
    if (std::find(words.begin(), words.end(), value) == words.end()) {
        throw error(key,
                    fmt::format("expected one of {}, found \"{}\"", fmt::join(words, ", "), one_line(value)));
    }
    return value;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, double least, double most,
                                       std::optional<std::vector<double>> fallback) {
    const std::string expected = fmt::format("an array of {}numbers from {} to {}",
                                             count > 0 ? fmt::format("{} ", count) : "", least, most);
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, std::move(fallback), expected);
    }
    const toml::array* array = node->as_array();
    if (!array || array->empty() || (count > 0 && array->size() != count)) {
        throw error(key, fmt::format("expected {}, found {}", expected,
                                     array ? fmt::format("{} elements", array->size()) : found(*node)));
    }
    std::vector<double> values;
    for (const toml::node& element : *array) {
        const auto value = element.is_number() ? element.value<double>() : std::nullopt;
        if (!value || !std::isfinite(*value) || *value < least || *value > most) {
            throw error(key, fmt::format("expected {}, found the element {}", expected, found(element)));
        }
        values.push_back(*value);
    }
    return values;
}

std::vector<std::string> TomlTable::texts(std::string_view key,
                                          std::optional<std::vector<std::string>> fallback) {
    const toml::node* node = node_->find(key);
    if (!node) {
        return required(key, std::move(fallback), "an array of texts");
    }
    const toml::array* array = node->as_array();
    if (!array || array->empty()) {
        throw error(key, fmt::format("expected an array of texts, found {}", found(*node)));
    }
    std::vector<std::string> values;
    for (const toml::node& element : *array) {
        if (!element.is_string()) {
            throw error(key, fmt::format("expected an array of texts, found the element {}", found(element)));
        }
        values.push_back(*element.value<std::string>());
    }
    return values;
}

TomlTable TomlTable::table(std::string_view key) {
    const toml::node* node = node_->find(key);
    auto child = std::make_shared<Node>();
    child->root = node_->root;
    child->file = node_->file;
    child->prefix = fmt::format("{}{}.", node_->prefix, key);
    child->table = &empty_table;
    if (node) {
        if (!node->is_table()) {
            throw error(key, fmt::format("expected a table, found {}", found(*node)));
        }
        child->table = node->as_table();
        child->line = node->source().begin.line;
    }
    node_->children.push_back(child);
    return TomlTable(child);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
    const toml::node* node = node_->find(key);
    std::vector<TomlTable> result;
    if (!node) {
        return result;
    }
    const toml::array* array = node->as_array();
    if (!array) {
        throw error(key, fmt::format("expected an array of tables, found {}", found(*node)));
    }
    for (const toml::node& element : *array) {
        if (!element.is_table()) {
            throw error(key,
                        fmt::format("expected an array of tables, found the element {}", found(element)));
        }
        auto child = std::make_shared<Node>();
        child->root = node_->root;
        child->file = node_->file;
        child->prefix = fmt::format("{}{}[{}].", node_->prefix, key, result.size());
        child->table = element.as_table();
        child->line = element.source().begin.line;
        node_->children.push_back(child);
        result.push_back(TomlTable(child));
    }
    return result;
}

void TomlTable::finish() const {
    for (const auto& [key, value] : *node_->table) {
        if (!node_->read.contains(key.str())) {
            std::string known;
            for (const auto& name : node_->read) {
                known += (known.empty() ? "" : ", ") + name;
            }
            throw error(key.str(), fmt::format("unknown field; expected one of {}", known));
        }
    }
    for (const auto& child : node_->children) {
        TomlTable(child).finish();
    }
}

} // namespace support
