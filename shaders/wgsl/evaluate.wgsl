// Vertices of flames from their control nets, by the tables of `lucerna_nurbs` (`docs/nurbs.md` has the layout and the
// formulas; all weights are 1 here). One workgroup for each ring of vertices of a flame: it contracts the net along v,
// then each thread makes pairs of vertices that mirror each other about the wick, whose largest distance is the flame's
// thickness there.

struct Vertex {
    position: vec3f,
    height: f32,
    normal: vec3f,
    radius: f32,
    uv: vec2f,
    flame: u32,
    padding: u32,
}

@group(0) @binding(0) var<storage, read> tables: array<u32>;
// x, y, z and the height in the flame.
@group(0) @binding(1) var<storage, read> points: array<vec4f>;
// For each flame: where its table starts, its first control point, its first vertex; w: unused.
@group(0) @binding(2) var<storage, read> nets: array<vec4u>;
@group(0) @binding(3) var<storage, read_write> vertices: array<Vertex>;

const THREADS = 64u;
// Half thickness of a flame that has none, m: `half_thickness` in `lucerna_flame`.
const THINNEST_M = 1e-5;
// A derivative shorter than this, as a share of the control points it comes from, is rounding.
const FLAT = 64.0 * 1.1920929e-7;
// The square of the sine below which two tangents have no plane.
const PARALLEL = 1.1920929e-7;
const TINY = 1e-30;

// Most rows of a net: as `MOST_ROWS` in `lucerna_render`.
const MOST_ROWS = 256u;

// The net contracted along v, for all rows: the points of this ring's control polygon about its origin, and their
// derivatives along v.
var<workgroup> polygon: array<vec4f, MOST_ROWS>;
var<workgroup> slopes: array<vec3f, MOST_ROWS>;
var<workgroup> widest: array<f32, THREADS>;

// A ring of one flame: what its vertices have in common.
struct Ring {
    // Where the table starts, and the ring's sample along v.
    table: u32,
    v: u32,
    first_point: u32,
    // Control points of a net along v, of a sample along u, of one along v.
    n_v: u32,
    p: u32,
    q: u32,
    // A control point that the ring depends on: differences from it keep their digits.
    origin: vec4f,
    lower: bool,
    upper: bool,
    pole: bool,
    // -1 where normals are turned over.
    side: f32,
    first_vertex: u32,
    flame: u32,
}

// A point of the surface about the ring's origin, with its derivatives, of which only the directions matter.
struct Jet {
    s: vec4f,
    su: vec3f,
    sv: vec3f,
    suv: vec3f,
    // Largest coordinate of what was summed up.
    size: f32,
}

fn number(at: u32) -> f32 {
    return bitcast<f32>(tables[at]);
}

fn largest(a: vec3f) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// The sum over a row of the net, from its first point, of values at the sample along v that starts at word `v`.
fn along_v(ring: Ring, v: u32, row: u32) -> vec4f {
    var sum = vec4f(0.0);
    for (var j = 0u; j < ring.q; j++) {
        sum += (points[row + tables[v + 1u + j]] - ring.origin) * number(v + 1u + ring.q + j);
    }
    return sum;
}

// Contracts row `i` of the net along v.
fn contract(ring: Ring, i: u32) {
    let row = ring.first_point + i * ring.n_v;
    var slope = vec3f(0.0);
    for (var j = 0u; j < ring.q; j++) {
        let point = points[row + tables[ring.v + 1u + j]] - ring.origin;
        slope += point.xyz * number(ring.v + 1u + 2u * ring.q + j);
    }
    polygon[i] = along_v(ring, ring.v, row);
    slopes[i] = slope;
}

// The ring at the sample along u that starts at word `u`.
fn jet_at(ring: Ring, u: u32) -> Jet {
    var jet: Jet;
    for (var i = 0u; i < ring.p; i++) {
        let row = tables[u + 1u + i];
        let value = number(u + 1u + ring.p + i);
        let slope = number(u + 1u + 2u * ring.p + i);
        let point = polygon[row];
        jet.s += point * value;
        jet.su += point.xyz * slope;
        jet.sv += slopes[row] * value;
        jet.suv += slopes[row] * slope;
        jet.size = max(jet.size, max(largest(point.xyz), largest(slopes[row])));
    }
    return jet;
}

// A point of the surface about the ring's origin, for samples along u and v that start at these words.
fn point_at(ring: Ring, u: u32, v: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < ring.p; i++) {
        let row = ring.first_point + tables[u + 1u + i] * ring.n_v;
        sum += along_v(ring, v, row).xyz * number(u + 1u + ring.p + i);
    }
    return sum;
}

// The direction of `a x b`; nothing where that is rounding.
fn unit_cross(a: vec3f, b: vec3f) -> vec3f {
    // Brought to size 1 first: the product of two short vectors is too small to square.
    let normal = cross(a / max(largest(a), TINY), b / max(largest(b), TINY));
    let square = dot(normal, normal);
    return select(vec3f(0.0), normal * inverseSqrt(max(square, TINY)), square > PARALLEL);
}

// Where nothing says which way the surface faces: along the net, outwards at its lower end.
fn along(ring: Ring) -> vec3f {
    let way = points[ring.first_point + ring.n_v - 1u].xyz - points[ring.first_point].xyz;
    let size = largest(way);
    if size <= TINY {
        return vec3f(0.0, 1.0, 0.0);
    }
    return normalize(way / size) * select(1.0, -1.0, ring.lower);
}

// The normal of the triangle between vertex `i` of a pole and the next ring; nothing where that is rounding.
fn face_normal(ring: Ring, pole: vec3f, i: u32) -> vec3f {
    let width = 1u + 3u * ring.q;
    let v = select(ring.v - width, ring.v + width, ring.lower);
    let u = ring.table + tables[ring.table + 7u] + i * (1u + 3u * ring.p);
    let to_west = point_at(ring, u, v) - pole;
    let to_east = point_at(ring, u + 1u + 3u * ring.p, v) - pole;
    return unit_cross(to_west, to_east) * select(1.0, -1.0, ring.lower);
}

fn normal_of(ring: Ring, jet: Jet, i: u32) -> vec3f {
    let flat = FLAT * jet.size;
    var su = jet.su;
    // Where the first or last row turns back or is a point, its neighbours say which way u goes.
    if (ring.lower || ring.upper) && largest(su) <= flat && largest(jet.suv) > flat {
        su = jet.suv * select(-1.0, 1.0, ring.lower);
    }
    var normal = unit_cross(su, jet.sv);
    if largest(su) <= flat || largest(jet.sv) <= flat || all(normal == vec3f(0.0)) {
        // The control points around a pole are one: the surface has no tangents there.
        if ring.pole {
            normal = face_normal(ring, jet.s.xyz, i);
        }
        if all(normal == vec3f(0.0)) {
            return along(ring);
        }
    }
    return normal * ring.side;
}

// Makes vertex `i` of a ring, all but its radius, and returns its position.
fn make_vertex(ring: Ring, i: u32) -> vec3f {
    let start = select(tables[ring.table + 7u], tables[ring.table + 9u], ring.pole);
    let u = ring.table + start + i * (1u + 3u * ring.p);
    let jet = jet_at(ring, u);
    var point = ring.origin + jet.s;
    if ring.pole {
        // The same sums for all vertices of a pole: they agree bit for bit.
        point = ring.origin + jet_at(ring, ring.table + tables[ring.table + 7u]).s;
    }
    let at = ring.first_vertex + i;
    vertices[at].position = point.xyz;
    vertices[at].height = clamp(point.w, 0.0, 1.0);
    vertices[at].normal = normal_of(ring, jet, i);
    vertices[at].uv = vec2f(number(u), 1.0 - number(ring.v));
    vertices[at].flame = ring.flame;
    vertices[at].padding = 0u;
    return point.xyz;
}

@compute @workgroup_size(THREADS)
fn cs_evaluate(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) thread: u32) {
    // Rings along x, flames along y.
    let net = nets[group.y];
    let table = net.x;
    let columns = tables[table];
    let rows = tables[table + 1u];
    let row = group.x;
    if row > rows {
        return;
    }
    let flags = tables[table + 3u];
    var ring: Ring;
    ring.table = table;
    ring.first_point = net.y;
    ring.n_v = tables[table + 4u];
    ring.p = tables[table + 5u];
    ring.q = tables[table + 6u];
    ring.v = table + tables[table + 8u] + row * (1u + 3u * ring.q);
    // An end of v that is open, and whether it is a point.
    ring.lower = row == 0u && (flags & 8u) != 0u;
    ring.upper = row == rows && (flags & 8u) != 0u;
    ring.pole = (row == 0u && (flags & 2u) != 0u) || (row == rows && (flags & 4u) != 0u);
    ring.side = select(1.0, -1.0, (flags & 1u) != 0u);
    ring.flame = group.y;
    // A pole has a vertex less than other rings.
    let missing = select(0u, (flags >> 1u) & 1u, row > 0u);
    ring.first_vertex = net.z + row * (columns + 1u) - missing;
    let last = columns - select(0u, 1u, ring.pole);

    ring.origin = points[ring.first_point + tables[ring.v + 1u]];
    let net_rows = tables[table + 10u] / ring.n_v;
    for (var i = thread; i < net_rows; i += THREADS) {
        contract(ring, i);
    }
    workgroupBarrier();

    var most = 0.0;
    for (var i = thread; 2u * i <= last; i += THREADS) {
        let across = make_vertex(ring, i) - make_vertex(ring, last - i);
        most = max(most, dot(across, across));
    }
    widest[thread] = most;
    workgroupBarrier();
    for (var half = THREADS / 2u; half > 0u; half /= 2u) {
        if thread < half {
            widest[thread] = max(widest[thread], widest[thread + half]);
        }
        workgroupBarrier();
    }
    let radius = max(0.5 * sqrt(widest[0]), THINNEST_M);
    for (var i = thread; 2u * i <= last; i += THREADS) {
        vertices[ring.first_vertex + i].radius = radius;
        vertices[ring.first_vertex + last - i].radius = radius;
    }
}
