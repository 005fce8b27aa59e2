// Reads the tables of potential_flow/make_truths.py.
#pragma once

#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/tests/test_paths.hpp"

namespace pelagic {

/// Returns the text of a file in Pelagic's sources.
inline std::string text_of_source(const std::string& file) {
    std::ifstream stream(in_sources(file));
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw std::runtime_error("cannot read " + file);
    return text.str();
}

/// A body's coefficients, forces and motions at one wave number, by the columns' names.
struct TruthRow {
    std::map<std::string, double> values;

    double operator[](const std::string& column) const { return values.at(column); }
    /// Returns the columns of real and imaginary part, of factors of exp(i omega t).
    std::complex<double> complex(const std::string& name) const {
        return {values.at(name + "_re"), values.at(name + "_im")};
    }
    bool is_limit() const { return values.at("wave_number_radpm") == 0 || std::isinf(values.at("wave_number_radpm")); }
};

/// Returns the rows of tests/potential_flow/<body>.csv: infinite and zero frequency, then others.
inline std::vector<TruthRow> truths_of(const std::string& body) {
    std::ifstream file(in_sources("tests/potential_flow/" + body + ".csv"));
    std::string line, cell;
    if (!std::getline(file, line)) throw std::runtime_error("no truths of " + body);
    std::vector<std::string> names;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    std::vector<TruthRow> rows;
    while (std::getline(file, line)) {
        TruthRow row;
        std::istringstream cells(line);
        for (const std::string& name : names) {
            std::getline(cells, cell, ',');
            row.values[name] = std::strtod(cell.c_str(), nullptr);
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace pelagic
