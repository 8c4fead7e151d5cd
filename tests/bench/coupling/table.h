#pragma once

#include <iosfwd>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace ode::soft {

/// What stands in one place of a table: as printed, as a number where it is one, and the size that
/// the number may have.
struct Cell {
    Cell(std::string words) : text(std::move(words)) {}
    Cell(const char* words) : text(words) {}
    /// @param pattern  of printf, for one double
    Cell(const char* pattern, double number, double mark = std::numeric_limits<double>::infinity());

    bool missed() const { return !(value >= -mark_ && value <= mark_) && is_number; }

    std::string text;
    double value = 0;
    bool is_number = false;

private:
    double mark_ = std::numeric_limits<double>::infinity();
};

/// Rows under named columns, as Markdown and as JSON.
class Table {
public:
    Table(std::string name, std::vector<std::string> columns);

    void add(std::vector<Cell> row); ///< one cell a column
    void print(std::ostream& out) const;
    /// "name": [{column: value, ...}, ...]
    void print_json(std::ostream& out) const;
    /// Sentences, one for each number beyond its mark.
    std::vector<std::string> misses() const;

private:
    std::string name_;
    std::vector<std::string> column_;
    std::vector<std::vector<Cell>> row_;
};

} // namespace ode::soft
