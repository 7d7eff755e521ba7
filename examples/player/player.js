// SPDX-License-Identifier: BSL-1.0
// What both drawings share: frames, shades, the clock and its controls.

const {movie, bodies, frames} = JSON.parse(document.getElementById("movie").textContent);
const dimension = movie.dimension, rotationNumbers = dimension === 2 ? 1 : 4;
const find = selector => document.querySelector(selector);

// ---- frames ----------------------------------------------------------------------------------------

function bytes(text) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
    const characters = atob(text), result = new Uint8Array(characters.length);
    for (let i = 0; i < result.length; ++i) result[i] = characters.charCodeAt(i);
    return result.buffer;
}

// Written with the least significant byte first, as every machine with a browser has them.
let members = null;
for (const frame of frames) {
    if (frame.members !== undefined) members = new Uint32Array(bytes(frame.members));
    frame.members = members;
}

/** Poses of the members of a frame and what they are shaded by. */
function decoded(k) {
    const {members, state, time} = frames[k], numbers = new Float32Array(bytes(state)), n = members.length;
    const rotations = n * dimension, scalars = rotations + n * rotationNumbers;
    return {time, members, position: numbers.subarray(0, rotations), rotation: numbers.subarray(rotations, scalars),
            scalar: movie.scalar ? numbers.subarray(scalars) : null};
}

// ---- the scene -------------------------------------------------------------------------------------

const length = v => Math.hypot(...v);

/** How far a shape reaches from the origin of its frame; nothing for what has no end. */
function reach(shape) {
    if (shape.kind === "ball") return length(shape.centre) + shape.radius;
    if (shape.kind === "hole" && dimension === 2) return length(shape.centre) + shape.radius;
    if (shape.kind === "box") return length(shape.low.map((x, k) => Math.max(-x, shape.high[k])));
    if (shape.kind === "compound") return Math.max(...shape.children.map(child => reach(child) ?? 0));
    if (shape.kind !== "core") return null;
    let farthest = 0;
    for (let i = 0; i < shape.vertices.length; i += dimension)
        farthest = Math.max(farthest, length(shape.vertices.slice(i, i + dimension)));
    return farthest + shape.radius;
}

const sorted = list => Float64Array.from(list).sort();
/** The value below which a share of a sorted list lies. */
const quantile = (sorted, share) => sorted[Math.round(share * (sorted.length - 1))];

/**
 * The room that some bodies are in over the whole movie; what flew off alone, farther than the others
 * are from each other, is left out.
 */
function room(samples, wanted) {
    const low = [], high = [];
    for (let k = 0; k < dimension; ++k) {
        const ends = [[], []];
        for (const {members, position} of samples)
            for (let i = 0; i < members.length; ++i) {
                if (!wanted(members[i])) continue;
                ends[0].push(position[dimension * i + k] - reaches[members[i]]);
                ends[1].push(position[dimension * i + k] + reaches[members[i]]);
            }
        if (ends[0].length === 0) return null;
        const [lows, highs] = ends.map(sorted);
        const inner = [quantile(lows, 0.01), quantile(highs, 0.99)], outer = [lows[0], highs.at(-1)];
        const far = outer[1] - outer[0] > 1.6 * (inner[1] - inner[0]);
        low.push(far ? inner[0] : outer[0]);
        high.push(far ? inner[1] : outer[1]);
    }
    return {low, high};
}

/** Free bodies all, obstacles as far as they are near these. */
function bounds(samples) {
    const free = room(samples, b => reaches[b] !== null && !bodies[b].obstacle);
    const fixed = room(samples, b => reaches[b] !== null && bodies[b].obstacle);
    if (!free || !fixed) return free ?? fixed ?? {low: Array(dimension).fill(-1), high: Array(dimension).fill(1)};
    const margin = 0.25 * Math.max(...free.high.map((x, k) => x - free.low[k]));
    return {low: free.low.map((x, k) => Math.min(x, Math.max(x - margin, fixed.low[k]))),
            high: free.high.map((x, k) => Math.max(x, Math.min(x + margin, fixed.high[k])))};
}

/** What white and black stand for: all but the strongest fiftieth are told apart. */
function scalarRange(samples) {
    const values = [];
    for (const {members, scalar} of samples)
        for (let i = 0; i < members.length; ++i)
            if (!bodies[members[i]].obstacle && Number.isFinite(scalar[i])) values.push(scalar[i]);
    if (values.length === 0) return [0, 1];
    const list = sorted(values), low = Math.min(0, quantile(list, 0.02)), high = Math.max(0, quantile(list, 0.98));
    return high > low ? [low, high] : list.at(-1) > low ? [low, list.at(-1)] : [low, low + 1];
}

const reaches = bodies.map(body => reach(body.shape));
// As many frames as show where things are, and no more than are read in a moment.
const sampled = Math.max(2, Math.min(frames.length, 100, Math.floor(3e5 / (1 + bodies.length))));
const samples = [...new Set(Array.from({length: sampled}, (_, k) => Math.round(k * (frames.length - 1) / (sampled - 1))))].map(decoded);
const scene = {dimension, bodies, bounds: bounds(samples)};
const range = movie.scalar ? scalarRange(samples) : null;

// ---- shades ----------------------------------------------------------------------------------------

// The more, the farther from the paper: towards black on white, towards white on black.
const THEMES = {
    light: {least: 0.97, most: 0.28, sheet: "#ffffff", edge: "#4a4a4a", wall: "#e4e1da", wallEdge: "#1a1a1a", rim: "#7a7a76", plain: "#c8d3dd",
            obstacle: "#d3cfc6", unknown: "#ecdfbd"},
    dark: {least: 0.3, most: 0.96, sheet: "#1b1f23", edge: "#868d95", wall: "#2b3137", wallEdge: "#b9bec4", rim: "#7b838b", plain: "#51606e",
           obstacle: "#3a4149", unknown: "#5c5138"},
};
const GREYS = 128;
const dark = matchMedia("(prefers-color-scheme: dark)");

function hex(lightness) {
    const part = Math.round(255 * lightness).toString(16).padStart(2, "0");
    return `#${part}${part}${part}`;
}

function theme() {
    const one = THEMES[dark.matches ? "dark" : "light"];
    return {...one, dark: dark.matches, greys: Array.from({length: GREYS}, (_, k) => hex(one.least + (one.most - one.least) * k / (GREYS - 1)))};
}

/** The colours of a frame; `of(i)` is that of its i-th member. */
function colours(frame) {
    const shaded = range && find("#shading").value === "scalar";
    const of = i => {
        if (bodies[frame.members[i]].obstacle) return current.obstacle;
        if (!shaded) return current.plain;
        const share = (frame.scalar[i] - range[0]) / (range[1] - range[0]);
        return Number.isNaN(share) ? current.unknown : current.greys[Math.round(Math.min(Math.max(share, 0), 1) * (GREYS - 1))];
    };
    return {...current, of};
}

/** 1, 2 or 5 times a power of ten, not above x. */
function nice(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return power * ([5, 2].find(digit => digit * power <= x * (1 + 1e-9)) ?? 1);
}

function legend() {
    find(".legend").hidden = !range || find("#shading").value !== "scalar";
    if (!range) return;
    find(".scalar").textContent = movie.scalar;
    find(".unit").textContent = movie.unit ? `[${movie.unit}]` : "";
    find(".bar").style.background = `linear-gradient(to right, ${current.greys[0]}, ${current.greys.at(-1)})`;
    const [low, high] = range, step = nice((high - low) / 2.5), ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9); ++k) {
        const tick = document.createElement("span"), share = (k * step - low) / (high - low);
        tick.textContent = String(Number((k * step).toPrecision(3))).replace("-", "−");
        tick.style.left = `${100 * share}%`;
        tick.classList.toggle("end", share > 0.95);
        ticks.push(tick);
    }
    find(".ticks").replaceChildren(...ticks);
}

// ---- the clock -------------------------------------------------------------------------------------

const SPEEDS = [0.001, 0.003, 0.01, 0.03, 0.1, 0.25, 0.5, 1, 2, 4, 10, 30, 100, 1000];
const first = frames[0].time, last = frames.at(-1).time;
const state = {k: 0, time: first, playing: false, speed: 1, before: null, frame: null};
const ICONS = {play: "M3 1l11 7-11 7z", pause: "M3 1h4v14H3zM9 1h4v14H9z"};
// So many decimals that frames are told apart.
const decimals = frames.length < 2 ? 3 : Math.min(9, Math.max(2, Math.ceil(-Math.log10((last - first) / (frames.length - 1)) - 1e-9) + 1));

function duration(seconds) {
    return `${seconds.toFixed(decimals).replace("-", "−")} s`;
}

/** The last frame that is not later than a time. */
function frameAt(time) {
    let low = 0, high = frames.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (frames[middle].time <= time) low = middle;
        else high = middle - 1;
    }
    return low;
}

function seek(k, time = frames[k].time) {
    state.time = time;
    if (k === state.k && state.frame) return;
    state.k = k;
    state.frame = decoded(k);
    find("#slider").value = k;
    find("#slider").setAttribute("aria-valuetext", duration(frames[k].time));
    const whole = document.createElement("span");
    whole.textContent = ` / ${duration(last)}`;
    find("#time").replaceChildren(duration(frames[k].time), whole);
    redraw();
}

function play(on) {
    if (on === state.playing || (on && frames.length < 2)) return;
    if (on && state.k === frames.length - 1) seek(0);
    state.playing = on;
    state.before = null;
    find("#play").setAttribute("aria-label", on ? "Pause" : "Play");
    find("#play path").setAttribute("d", on ? ICONS.pause : ICONS.play);
    if (on) requestAnimationFrame(tick);
}

function tick(now) {
    if (!state.playing) return;
    // A page that was hidden goes on where it was.
    const passed = state.before === null ? 0 : Math.min(now - state.before, 250) / 1000;
    state.before = now;
    const time = Math.min(state.time + passed * state.speed, last);
    seek(frameAt(time), time);
    if (time >= last) play(false);
    else requestAnimationFrame(tick);
}

function step(by) {
    play(false);
    seek(Math.min(Math.max(state.k + by, 0), frames.length - 1));
}

// ---- the page --------------------------------------------------------------------------------------

let current = theme(), asked = false, drawing = null;

/** Draws what is shown anew, once for all that has changed. */
function redraw() {
    if (asked || !drawing) return;
    asked = true;
    requestAnimationFrame(() => {
        asked = false;
        drawing.draw(state.frame, colours(state.frame));
    });
}

function resized() {
    const stage = find("#stage");
    drawing.resize(stage.clientWidth, stage.clientHeight, window.devicePixelRatio || 1);
    // At once: a canvas is empty after it was resized.
    drawing.draw(state.frame, colours(state.frame));
}

function fillSpeeds() {
    const whole = last - first, at = whole > 0 && (whole < 1 || whole > 90)
        ? SPEEDS.reduce((best, one) => Math.abs(Math.log(whole / one / 10)) < Math.abs(Math.log(whole / best / 10)) ? one : best) : 1;
    for (const speed of SPEEDS) find("#speed").add(new Option(`${speed}×`, speed, speed === at, speed === at));
    state.speed = at;
}

function listen() {
    find("#play").addEventListener("click", () => play(!state.playing));
    find("#back").addEventListener("click", () => step(-1));
    find("#forth").addEventListener("click", () => step(1));
    find("#fit").addEventListener("click", () => { drawing.fit(); redraw(); });
    find("#slider").addEventListener("input", event => { play(false); seek(Number(event.target.value)); });
    find("#speed").addEventListener("change", event => { state.speed = Number(event.target.value); });
    find("#shading").addEventListener("change", () => { legend(); redraw(); });
    dark.addEventListener("change", () => { current = theme(); legend(); redraw(); });
    new ResizeObserver(resized).observe(find("#stage"));
    document.addEventListener("keydown", event => {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        const tag = event.target.tagName, ten = event.shiftKey ? 10 : 1;
        const own = tag === "SELECT" || (tag === "BUTTON" && event.key === " ")
            || (tag === "INPUT" && event.key !== " " && event.key.length > 1 && !event.shiftKey);
        const acts = {" ": () => play(!state.playing), ArrowLeft: () => step(-ten), ArrowRight: () => step(ten),
                      Home: () => step(-Infinity), End: () => step(Infinity),
                      f: () => find("#fit").click(), F: () => find("#fit").click()};
        if (own || !acts[event.key]) return;
        event.preventDefault();
        acts[event.key]();
    });
}

function begin() {
    find("h1").textContent = movie.title || "talus movie";
    find("#mouse").textContent = MOUSE;
    find("#slider").max = frames.length - 1;
    find(".shading").hidden = !range;
    find("#shading option").textContent = movie.scalar;
    fillSpeeds();
    legend();
    seek(0);
    try {
        drawing = new Drawing(find("#stage"), scene, redraw);
    } catch (problem) {
        const sentence = document.createElement("p");
        sentence.textContent = `This browser does not draw in space (${problem.message}).`;
        find("#stage").append(sentence);
        return;
    }
    listen();
    resized();
    // For tests: what is shown.
    window.talusPlayer = {frameCount: frames.length, state, scene, range, drawing};
}

begin();
