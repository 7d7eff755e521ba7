// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace talus {

/// Numbers attached to the points or to the cells of a VTK data set.
struct VtkField {
    std::string name;            ///< with its unit, such as "load [N]"
    int components = 1;          ///< 1 for numbers, 3 for vectors
    std::vector<double> values;  ///< component by component
};

/// Points, lines and polygons with fields, for ParaView. Cells are numbered as VTK does: all single
/// points first, then all lines, then all polygons; cell fields follow that order.
struct VtkPolyData {
    using Cell = std::vector<std::int64_t>;  ///< indices of points
    std::vector<Vector<3>> points;           ///< [m]
    std::vector<Cell> vertices, lines, polygons;
    std::vector<VtkField> point_fields, cell_fields;
};

namespace detail {

inline void require_valid(const VtkPolyData& data) {
    for (const auto* cells : {&data.vertices, &data.lines, &data.polygons})
        for (const auto& cell : *cells)
            for (const auto index : cell)
                require_in("point index of a VTK cell", static_cast<double>(index), 0.0,
                           static_cast<double>(data.points.size()) - 1.0);
    const std::size_t cell_count = data.vertices.size() + data.lines.size() + data.polygons.size();
    const auto check = [](const VtkField& field, std::size_t count) {
        const double expected = static_cast<double>(count) * field.components;
        require_in("number of values of the VTK field '" + field.name + "'",
                   static_cast<double>(field.values.size()), expected, expected);
    };
    for (const auto& field : data.point_fields) check(field, data.points.size());
    for (const auto& field : data.cell_fields) check(field, cell_count);
}

inline std::string xml_escaped(const std::string& words) {
    std::string text;
    for (const char c : words) {
        if (c == '&')
            text += "&amp;";
        else if (c == '<')
            text += "&lt;";
        else if (c == '"')
            text += "&quot;";
        else
            text += c;
    }
    return text;
}

inline std::string vtk_cells(const char* tag, const std::vector<VtkPolyData::Cell>& cells) {
    std::string connectivity, offsets;
    std::size_t end = 0;
    for (const auto& cell : cells) {
        for (const auto index : cell) connectivity += std::to_string(index) + " ";
        end += cell.size();
        offsets += std::to_string(end) + " ";
    }
    const std::string name(tag);
    return "<" + name + ">\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
           connectivity +
           "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" "
           "format=\"ascii\">" +
           offsets + "</DataArray>\n</" + name + ">\n";
}

inline std::string vtk_fields(const char* tag, const std::vector<VtkField>& fields) {
    const std::string name(tag);
    std::string text = "<" + name + ">\n";
    for (const auto& field : fields) {
        text += "<DataArray type=\"Float64\" Name=\"" + xml_escaped(field.name) +
                "\" NumberOfComponents=\"" + std::to_string(field.components) +
                "\" format=\"ascii\">";
        for (const double x : field.values) text += text_of(x) + " ";
        text += "</DataArray>\n";
    }
    return text + "</" + name + ">\n";
}

}  // namespace detail

/// The text of an XML PolyData file (.vtp), nine significant digits. Throws input_error when an
/// index or the length of a field does not fit.
inline std::string vtp_text(const VtkPolyData& data) {
    detail::require_valid(data);
    const auto count = [](const auto& list) { return "\"" + std::to_string(list.size()) + "\""; };
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
        "NumberOfPoints=" +
        count(data.points) + " NumberOfVerts=" + count(data.vertices) +
        " NumberOfLines=" + count(data.lines) +
        " NumberOfStrips=\"0\" NumberOfPolys=" + count(data.polygons) + ">\n";
    text += detail::vtk_fields("PointData", data.point_fields);
    text += detail::vtk_fields("CellData", data.cell_fields);
    text += "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">";
    for (const auto& p : data.points)
        for (const double x : p) text += detail::text_of(x) + " ";
    text += "</DataArray>\n</Points>\n";
    text += detail::vtk_cells("Verts", data.vertices);
    text += detail::vtk_cells("Lines", data.lines);
    text += detail::vtk_cells("Polys", data.polygons);
    return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace talus
