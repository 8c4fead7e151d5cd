#include "base/error.h"
#include "mesh/raw_mesh.h"
#include "mesh/read.h"

#include <algorithm>

namespace ode::soft {

namespace {

constexpr std::int64_t kTetrahedron = 10, kQuadraticTetrahedron = 24;

// Kinds of cells that are no volumes, by their VTK numbers (vtkCellType.h): vertices, lines,
// triangles, quadrilaterals, and their quadratic kin.
bool is_ignored(std::int64_t type) {
    return (type >= 0 && type <= 9) || (type >= 21 && type <= 23) || type == 28 || type == 30 ||
           (type >= 34 && type <= 36);
}

const char* name_of(std::int64_t type) {
    switch (type) {
    case 11:
        return "a voxel";
    case 12:
    case 25:
    case 29:
    case 33:
        return "a hexahedron";
    case 13:
    case 26:
    case 31:
    case 32:
        return "a wedge";
    case 14:
    case 27:
    case 37:
        return "a pyramid";
    case 42:
        return "a polyhedron";
    default:
        return "of a kind without name here";
    }
}

class VtkFile {
public:
    VtkFile(std::string_view bytes, const std::string& name)
        : scan_(bytes, name), raw_(scan_, scan_) {}

    TetMesh read() {
        read_header();
        while (!(points_ && cells_ && types_)) {
            std::string section(scan_.word());
            for (char& c : section)
                c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            if (section.empty())
                scan_.refuse(format("the file ends before %s: write it again", !points_ ? "POINTS"
                                                                               : !cells_
                                                                                   ? "CELLS"
                                                                                   : "CELL_TYPES"));
            if (section == "POINTS" && !points_)
                read_points();
            else if (section == "CELLS" && !cells_)
                read_cells();
            else if (section == "CELL_TYPES" && !types_)
                read_types();
            else if (section == "FIELD")
                skip_field();
            else if (section == "METADATA")
                skip_metadata();
            else
                scan_.refuse(format("%s stands where POINTS, CELLS or CELL_TYPES is due: correct "
                                    "the counts before it",
                                    quote(section).c_str()));
        }
        add_elements();
        return raw_.finish();
    }

private:
    void read_header() {
        if (!scan_.line().starts_with("# vtk DataFile Version "))
            scan_.refuse("the first line is not '# vtk DataFile Version ...': save as legacy .vtk");
        scan_.line(); // title
        const std::string encoding(scan_.word());
        if (encoding != "ASCII" && encoding != "BINARY")
            scan_.refuse(
                format("the encoding is %s: give ASCII or BINARY", quote(encoding).c_str()));
        scan_.expect("DATASET");
        const std::string kind(scan_.word());
        if (kind != "UNSTRUCTURED_GRID")
            scan_.refuse(
                format("the data set is %s: save an UNSTRUCTURED_GRID", quote(kind).c_str()));
        if (encoding == "BINARY")
            scan_.set_binary(std::endian::native == std::endian::little);
    }

    // Bytes of a number of the type named by the next word.
    std::size_t read_type(std::string& type) {
        type = scan_.word();
        const auto is = [&](std::initializer_list<const char*> names) {
            return std::find(names.begin(), names.end(), type) != names.end();
        };
        const std::size_t bytes =
            is({"char", "unsigned_char", "vtktypeint8", "vtktypeuint8"})            ? 1
            : is({"short", "unsigned_short", "vtktypeint16", "vtktypeuint16"})      ? 2
            : is({"int", "unsigned_int", "float", "vtktypeint32", "vtktypeuint32"}) ? 4
            : is({"long", "unsigned_long", "double", "vtkIdType", "vtktypeint64", "vtktypeuint64"})
                ? 8
                : 0;
        if (bytes == 0)
            scan_.refuse(format("the type %s is unknown: save coordinates as float or double",
                                quote(type).c_str()));
        return bytes;
    }

    // Data begin behind the line of their keyword.
    void start_data() {
        if (scan_.is_binary())
            scan_.line();
    }

    void read_points() {
        const std::size_t keyword = scan_.place();
        const std::int64_t declared = scan_.integer("the number of points");
        std::string type;
        const std::size_t bytes = read_type(type);
        const std::size_t points = scan_.check_count(declared, "the number of points",
                                                     scan_.is_binary() ? 3 * bytes : 5, keyword);
        if (scan_.is_binary() && type != "float" && type != "double")
            scan_.refuse(format("the points are of type %s: save them as float or double",
                                quote(type).c_str()));
        start_data();
        for (std::size_t i = 0; i < points; ++i) {
            const std::size_t place = scan_.place();
            Vec3 x;
            for (double& c : x)
                c = !scan_.is_binary() ? scan_.real("a coordinate")
                    : bytes == 4       ? double{scan_.binary<float>("a coordinate")}
                                       : scan_.binary<double>("a coordinate");
            raw_.add_node(static_cast<std::int64_t>(i), x, place);
        }
        points_ = true;
    }

    std::int64_t read_index(std::size_t bytes, const char* what) {
        return !scan_.is_binary() ? scan_.integer(what)
               : bytes == 4       ? scan_.binary<std::int32_t>(what)
                                  : scan_.binary<std::int64_t>(what);
    }

    // Before version 5 each cell is a count and its points; since then, two arrays.
    void read_cells() {
        const std::size_t keyword = scan_.place();
        const std::int64_t declared = scan_.integer("the number of cells");
        const std::int64_t size = scan_.integer("the size of the cell list");
        std::string next(scan_.has_word_on_line() ? std::string_view{} : next_line_word());
        if (next == "OFFSETS") {
            read_offset_cells(declared, size, keyword);
        } else {
            const std::size_t least = scan_.is_binary() ? 4 : 2;
            const std::size_t cells =
                scan_.check_count(declared, "the number of cells", least, keyword);
            const std::size_t total =
                scan_.check_count(size, "the size of the cell list", least, keyword);
            start_data();
            for (std::size_t i = 0; i < cells; ++i) {
                cell_place_.push_back(scan_.place());
                const std::int64_t nodes = read_index(4, "a cell's number of points");
                const std::size_t used = node_.size() + i;
                if (nodes < 0 || total - used <= static_cast<std::size_t>(nodes))
                    scan_.refuse(
                        format("cell %zu has %lld points, beyond the size %zu of the list: "
                               "correct the counts",
                               i, static_cast<long long>(nodes), total),
                        cell_place_.back());
                for (std::int64_t n = 0; n < nodes; ++n)
                    node_.push_back(read_index(4, "a cell's point"));
                cell_end_.push_back(node_.size());
            }
            if (node_.size() + cells != total)
                scan_.refuse(format("the cells take %zu numbers, the header promises %zu: correct "
                                    "the counts",
                                    node_.size() + cells, total),
                             keyword);
        }
        cells_ = true;
    }

    // The first word behind the end of this line, left unread: OFFSETS, or data of an older
    // version.
    std::string next_line_word() {
        Scan ahead = scan_;
        ahead.line();
        return std::string(ahead.take(std::min<std::size_t>(ahead.left(), 7), "CELLS"));
    }

    void read_offset_cells(std::int64_t declared, std::int64_t size, std::size_t keyword) {
        scan_.expect("OFFSETS");
        std::string type;
        std::size_t bytes = read_type(type);
        const std::size_t offsets = scan_.check_count(declared, "the number of cell offsets",
                                                      scan_.is_binary() ? bytes : 2, keyword);
        const std::size_t places = scan_.place();
        start_data();
        std::int64_t before = 0;
        for (std::size_t i = 0; i < offsets; ++i) {
            const std::size_t place = scan_.place();
            const std::int64_t offset = read_index(bytes, "a cell offset");
            if (offset < before || offset > size || (i == 0 && offset != 0) ||
                (i + 1 == offsets && offset != size))
                scan_.refuse(format("cell offset %zu is %lld: let offsets rise from 0 to %lld", i,
                                    static_cast<long long>(offset), static_cast<long long>(size)),
                             place);
            before = offset;
            if (i > 0)
                cell_end_.push_back(static_cast<std::size_t>(offset));
        }
        if (offsets == 0)
            scan_.refuse("there are no cell offsets: export the volume mesh", places);
        scan_.expect("CONNECTIVITY");
        bytes = read_type(type);
        scan_.check_count(size, "the number of cell points", scan_.is_binary() ? bytes : 2,
                          keyword);
        start_data();
        for (const std::size_t end : cell_end_) {
            cell_place_.push_back(scan_.place());
            while (node_.size() < end)
                node_.push_back(read_index(bytes, "a cell's point"));
        }
    }

    void read_types() {
        const std::size_t types =
            scan_.count("the number of cell types", scan_.is_binary() ? 4 : 2);
        start_data();
        for (std::size_t i = 0; i < types; ++i)
            type_.push_back(read_index(4, "a cell type"));
        types_ = true;
    }

    // FIELD name arrays; each array: name components tuples type, data.
    void skip_field() {
        scan_.word();
        const std::size_t arrays = scan_.count("the number of arrays", 8);
        for (std::size_t i = 0; i < arrays; ++i) {
            scan_.word();
            const std::size_t components = scan_.count("the number of components", 1);
            const std::size_t tuples = scan_.count("the number of tuples", 1);
            std::string type;
            const std::size_t bytes = read_type(type);
            // A product beyond the file's length must not wrap round.
            const std::size_t most = scan_.left();
            const std::size_t values =
                components != 0 && tuples > most / components ? most + 1 : components * tuples;
            const std::size_t checked =
                scan_.check_count(static_cast<std::int64_t>(values), "the size of an array",
                                  scan_.is_binary() ? bytes : 2, scan_.place());
            start_data();
            if (scan_.is_binary())
                scan_.take(checked * bytes, "an array");
            else
                for (std::size_t v = 0; v < checked; ++v)
                    scan_.word();
        }
    }

    // Runs to an empty line.
    void skip_metadata() {
        scan_.line();
        while (!scan_.line().empty()) {
        }
    }

    void add_elements() {
        if (type_.size() != cell_end_.size())
            scan_.refuse(format("there are %zu cells but %zu cell types: give one each",
                                cell_end_.size(), type_.size()));
        std::size_t begin = 0;
        for (std::size_t i = 0; i < type_.size(); ++i) {
            const std::size_t end = cell_end_[i];
            const auto number = static_cast<std::int64_t>(i);
            const std::int64_t type = type_[i];
            if (type == kTetrahedron || type == kQuadraticTetrahedron) {
                const std::size_t due = type == kTetrahedron ? 4 : 10;
                if (end - begin != due)
                    scan_.refuse(
                        format("element %zu has %zu nodes, its type %lld wants %zu: correct "
                               "the cell or its type",
                               i, end - begin, static_cast<long long>(type), due),
                        cell_place_[i]);
                // The order of the mid-edge nodes is that of kTetEdge.
                raw_.add_element(number, std::span(node_).subspan(begin, due), RawMesh::kNoGroup,
                                 cell_place_[i]);
            } else if (!is_ignored(type)) {
                refuse_kind(scan_, cell_place_[i], number, name_of(type));
            }
            begin = end;
        }
    }

    Scan scan_;
    RawMesh raw_;
    bool points_ = false, cells_ = false, types_ = false;
    std::vector<std::int64_t> node_; // of all cells, one after the other
    std::vector<std::size_t> cell_end_, cell_place_;
    std::vector<std::int64_t> type_;
};

} // namespace

TetMesh read_vtk(std::string_view bytes, const std::string& name) {
    return VtkFile(bytes, name).read();
}

} // namespace ode::soft
