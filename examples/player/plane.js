// SPDX-License-Identifier: BSL-1.0
// Bodies of the plane on a canvas, y upwards. Drawn again when something has changed, and only then.

const MOUSE = "wheel zooms, dragging moves";

/** The outline of a shape in its own frame, and whether it is a wall, which has no end. */
function outline(shape) {
    const path = new Path2D();
    trace(shape, path);
    const wall = shape.kind === "half_space" || shape.kind === "hole";
    return {path, wall, clump: shape.kind === "compound", ball: shape.kind === "ball" ? shape : null};
}

function trace(shape, path) {
    if (shape.kind === "ball") {
        path.moveTo(shape.centre[0] + shape.radius, shape.centre[1]);
        path.arc(shape.centre[0], shape.centre[1], shape.radius, 0, 2 * Math.PI);
        path.closePath();
    } else if (shape.kind === "core") {
        traceCore(shape, path);
    } else if (shape.kind === "compound") {
        for (const child of shape.children) trace(child, path);
    } else if (shape.kind === "box") {
        path.rect(shape.low[0], shape.low[1], shape.high[0] - shape.low[0], shape.high[1] - shape.low[1]);
    }
}

/** Sides pushed outwards by the rounding, with arcs about the corners between them. */
function traceCore({vertices, faces, radius}, path) {
    const next = new Map(faces);
    const at = v => [vertices[2 * v], vertices[2 * v + 1]];
    const outwards = v => {
        const [x, y] = at(v), [u, w] = at(next.get(v));
        return Math.atan2(x - u, w - y);
    };
    // A core of points alone: a ball about each.
    if (faces.length === 0) {
        for (let i = 0; i < vertices.length; i += 2) trace({kind: "ball", centre: vertices.slice(i, i + 2), radius}, path);
        return;
    }
    let v = faces[0][0];
    const start = outwards(v), [x0, y0] = at(next.get(v));
    if (radius > 0) path.moveTo(x0 + radius * Math.cos(start), y0 + radius * Math.sin(start));
    for (let k = 0; k < faces.length; ++k) {
        const w = next.get(v), [x, y] = at(w);
        if (radius > 0) path.arc(x, y, radius, outwards(v), outwards(w));
        else if (k === 0) path.moveTo(x, y);
        else path.lineTo(x, y);
        v = w;
    }
    path.closePath();
}

class Drawing {
    constructor(stage, scene, changed) {
        this.scene = scene;
        this.changed = changed;
        this.canvas = document.createElement("canvas");
        stage.append(this.canvas);
        this.context = this.canvas.getContext("2d");
        this.outlines = scene.bodies.map(body => outline(body.shape));
        this.fitted = true;
        this.listen();
    }

    resize(width, height, ratio) {
        this.ratio = ratio;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        if (this.fitted) this.fit();
    }

    /** All bodies within the window, in the middle. */
    fit() {
        const {low, high} = this.scene.bounds, room = 1.06;
        this.scale = Math.min(this.canvas.width / (room * (high[0] - low[0])), this.canvas.height / (room * (high[1] - low[1])));
        this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
        this.fitted = true;
    }

    // ---- the mouse, and fingers ---------------------------------------------------------------------

    listen() {
        const down = new Map(), place = event => [event.offsetX * this.ratio, event.offsetY * this.ratio];
        this.canvas.addEventListener("wheel", event => {
            event.preventDefault();
            const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1);
            this.zoom(place(event), Math.exp(-0.0016 * pixels));
        }, {passive: false});
        this.canvas.addEventListener("pointerdown", event => {
            this.canvas.setPointerCapture(event.pointerId);
            down.set(event.pointerId, place(event));
        });
        this.canvas.addEventListener("pointermove", event => {
            if (!down.has(event.pointerId)) return;
            const before = [...down.values()];
            down.set(event.pointerId, place(event));
            this.follow(before, [...down.values()]);
        });
        for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, event => down.delete(event.pointerId));
        this.canvas.addEventListener("dblclick", () => { this.fit(); this.changed(); });
    }

    /** What was under one or two fingers stays under them. */
    follow(before, after) {
        const middle = points => [0, 1].map(i => points.reduce((sum, p) => sum + p[i], 0) / points.length);
        const [from, to] = [middle(before), middle(after)];
        this.centre[0] -= (to[0] - from[0]) / this.scale;
        this.centre[1] += (to[1] - from[1]) / this.scale;
        const spread = ([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1]);
        this.fitted = false;
        if (after.length === 2 && spread(before) > 0) this.zoom(to, spread(after) / spread(before));
        else this.changed();
    }

    zoom([x, y], factor) {
        const dx = (x - this.canvas.width / 2) / this.scale, dy = (this.canvas.height / 2 - y) / this.scale;
        const {low, high} = this.scene.bounds, size = Math.max(high[0] - low[0], high[1] - low[1]);
        const least = 0.05 * Math.min(this.canvas.width, this.canvas.height) / size;
        const scale = Math.min(Math.max(this.scale * factor, least), 1e5 * least);
        const moved = 1 - this.scale / scale;
        this.centre = [this.centre[0] + dx * moved, this.centre[1] + dy * moved];
        this.scale = scale;
        this.fitted = false;
        this.changed();
    }

    // ---- a frame -----------------------------------------------------------------------------------

    draw(frame, colours) {
        const {context: c, canvas} = this;
        c.setTransform(1, 0, 0, 1, 0, 0);
        c.fillStyle = colours.sheet;
        c.fillRect(0, 0, canvas.width, canvas.height);
        c.lineJoin = "round";
        this.frame = frame;
        this.colours = colours;
        const each = (wanted, act) => {
            for (let i = 0; i < frame.members.length; ++i) {
                const one = this.outlines[frame.members[i]];
                if (one.wall === wanted) act(one, i);
            }
        };
        // What of a wall's rim is within another wall is covered.
        for (const part of ["rim", "inside"])
            each(true, (one, i) => this.drawWall(this.scene.bodies[frame.members[i]].shape, i, part));
        each(false, (one, i) => this.drawBody(one, i));
    }

    /** Metres of the body's frame; returns the length of a pixel of the screen in them. */
    enter(i) {
        const {position, rotation} = this.frame, s = this.scale;
        const cos = s * Math.cos(rotation[i]), sin = s * Math.sin(rotation[i]);
        this.context.setTransform(cos, -sin, -sin, -cos,
            this.canvas.width / 2 + s * (position[2 * i] - this.centre[0]),
            this.canvas.height / 2 - s * (position[2 * i + 1] - this.centre[1]));
        return this.ratio / s;
    }

    drawBody(one, i) {
        const c = this.context, pixel = this.enter(i);
        c.fillStyle = this.colours.of(i);
        c.strokeStyle = this.colours.edge;
        c.lineWidth = pixel * (one.clump ? 2 : 1);
        if (one.clump) c.stroke(one.path);  // lines within the clump are covered
        c.fill(one.path);
        if (!one.clump) c.stroke(one.path);
        if (one.ball && one.ball.radius > 4 * pixel) {  // shows how it turns
            const {radius: r, centre: [x, y]} = one.ball;
            c.beginPath();
            c.moveTo(x + 0.5 * r, y);
            c.lineTo(x + 0.85 * r, y);
            c.stroke();
        }
    }

    drawWall(shape, i, part) {
        const c = this.context, pixel = this.enter(i), p = this.frame.position;
        // Beyond the window, wherever the wall's frame stands.
        const far = (this.canvas.width + this.canvas.height) / this.scale
            + Math.hypot(p[2 * i] - this.centre[0], p[2 * i + 1] - this.centre[1]);
        c.fillStyle = this.colours.wall;
        c.strokeStyle = this.colours.wallEdge;
        c.lineWidth = 3 * pixel;  // of which half is seen
        c.beginPath();
        if (shape.kind === "hole") this.traceHole(shape, far, pixel, part);
        else this.traceHalfSpace(shape, far, part);
        if (part === "rim") c.stroke();
        else c.fill("evenodd");
    }

    traceHole({radius, centre: [x, y]}, far, pixel, part) {
        const c = this.context, reach = far + Math.hypot(x, y) + radius;
        c.arc(x, y, radius, 0, 2 * Math.PI);
        if (part === "rim") {  // with a mark that shows how it turns
            c.moveTo(x + radius, y);
            c.lineTo(x + radius - Math.min(8 * pixel, 0.2 * radius), y);
        } else {
            c.closePath();
            c.rect(x - reach, y - reach, 2 * reach, 2 * reach);
        }
    }

    traceHalfSpace({normal: [nx, ny], offset}, far, part) {
        const reach = far + Math.abs(offset);
        // (along, up) from the point of the surface nearest to the origin.
        const at = (along, up) => [(offset + up) * nx - along * ny, (offset + up) * ny + along * nx];
        this.context.moveTo(...at(-reach, 0));
        this.context.lineTo(...at(reach, 0));
        if (part === "rim") return;
        this.context.lineTo(...at(reach, -reach));
        this.context.lineTo(...at(-reach, -reach));
    }
}
