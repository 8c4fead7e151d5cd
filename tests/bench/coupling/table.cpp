#include "bench/coupling/table.h"

#include "base/error.h"

#include <cmath>
#include <ostream>

namespace ode::soft {
namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += c;
    }
    return out + '"';
}

} // namespace

Cell::Cell(const char* pattern, double number, double mark)
    : text(format(pattern, number)), value(number), is_number(true), mark_(mark) {}

Table::Table(std::string name, std::vector<std::string> columns)
    : name_(std::move(name)), column_(std::move(columns)) {}

void Table::add(std::vector<Cell> row) { row_.push_back(std::move(row)); }

void Table::print(std::ostream& out) const {
    for (const std::string& c : column_)
        out << "| " << c << ' ';
    out << "|\n";
    for (std::size_t i = 0; i < column_.size(); ++i)
        out << "|---";
    out << "|\n";
    for (const std::vector<Cell>& row : row_) {
        for (const Cell& cell : row)
            out << "| " << cell.text << ' ';
        out << "|\n";
    }
}

void Table::print_json(std::ostream& out) const {
    out << quoted(name_) << ": [";
    for (std::size_t r = 0; r < row_.size(); ++r) {
        out << (r == 0 ? "\n  {" : ",\n  {");
        for (std::size_t c = 0; c < column_.size(); ++c) {
            const Cell& cell = row_[r][c];
            out << (c == 0 ? "" : ", ") << quoted(column_[c]) << ": ";
            if (!cell.is_number)
                out << quoted(cell.text);
            else if (std::isfinite(cell.value))
                out << format("%.6g", cell.value);
            else
                out << "null";
        }
        out << '}';
    }
    out << "\n]";
}

std::vector<std::string> Table::misses() const {
    std::vector<std::string> all;
    for (const std::vector<Cell>& row : row_)
        for (std::size_t c = 0; c < row.size(); ++c)
            if (row[c].missed())
                all.push_back(name_ + ", " + row[0].text + ": " + column_[c] + " " + row[c].text);
    return all;
}

} // namespace ode::soft
