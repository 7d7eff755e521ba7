// SPDX-License-Identifier: BSL-1.0
// Bodies of space by three.js, z upwards. Drawn again when something has changed, and only then.
import * as THREE from "three";
import {OrbitControls} from "three/orbit";

const MOUSE = "dragging turns, wheel zooms, right button moves";

// ---- shapes ----------------------------------------------------------------------------------------

const points = vertices => Array.from({length: vertices.length / 3}, (_, i) => new THREE.Vector3().fromArray(vertices, 3 * i));

/** Flat faces, or smooth where there are so many that they stand for something round. */
function polytope({vertices, faces}) {
    const triangles = faces.flatMap(face => face.slice(2).map((v, k) => [face[0], face[k + 1], v])).flat();
    const indexed = new THREE.BufferGeometry();
    indexed.setAttribute("position", new THREE.Float32BufferAttribute(vertices, 3));
    indexed.setIndex(triangles);
    const geometry = faces.length > 120 ? indexed : indexed.toNonIndexed();
    geometry.computeVertexNormals();
    return geometry;
}

/** A rounded core: the farthest point in every direction of a sphere, whose normal it is. */
function rounded({vertices, radius}) {
    const sphere = new THREE.SphereGeometry(1, 40, 28), corners = points(vertices);
    const directions = sphere.getAttribute("normal"), position = sphere.getAttribute("position"), d = new THREE.Vector3();
    for (let i = 0; i < directions.count; ++i) {
        // Rounded, so that the two ends of the sphere's seam are one: else it gapes between corners.
        d.fromBufferAttribute(directions, i);
        for (const x of ["x", "y", "z"]) d[x] = Math.round(1e5 * d[x]) / 1e5;
        let best = corners[0];
        for (const corner of corners) if (corner.dot(d) > best.dot(d)) best = corner;
        position.setXYZ(i, best.x + radius * d.x, best.y + radius * d.y, best.z + radius * d.z);
    }
    return sphere;
}

function ballDetail(count) {
    return count < 1500 ? [28, 18] : count < 4000 ? [18, 12] : [12, 9];
}

/** What a shape is drawn by: pieces, each the instance of a form that others may share. */
function pieces(shape) {
    if (shape.kind === "compound") return shape.children.flatMap(pieces);
    if (shape.kind === "ball") {
        const local = new THREE.Matrix4().makeScale(shape.radius, shape.radius, shape.radius).setPosition(...shape.centre);
        return [{key: "ball", make: count => new THREE.SphereGeometry(1, ...ballDetail(count)), local}];
    }
    if (shape.kind === "box") {
        const size = shape.high.map((x, k) => x - shape.low[k]), middle = shape.high.map((x, k) => (x + shape.low[k]) / 2);
        return [{key: "box", make: () => new THREE.BoxGeometry(1, 1, 1), local: new THREE.Matrix4().makeScale(...size).setPosition(...middle)}];
    }
    if (shape.kind !== "core") return [];
    const round = shape.radius > 0 || shape.faces.length === 0;
    return [{key: JSON.stringify(shape), make: () => round ? rounded(shape) : polytope(shape), local: new THREE.Matrix4()}];
}

// ---- walls -----------------------------------------------------------------------------------------

/** The part of a convex polygon on the outer side of a plane. */
function clipped(polygon, normal, offset) {
    const heights = polygon.map(p => normal.dot(p) - offset);
    return polygon.flatMap((p, i) => {
        const j = (i + 1) % polygon.length, kept = heights[i] >= 0 ? [p] : [];
        if (heights[i] >= 0 !== heights[j] >= 0)
            kept.push(p.clone().lerp(polygon[j], heights[i] / (heights[i] - heights[j])));
        return kept;
    });
}

/** What the walls leave of the plane of one of them, within the room that is shown. */
function wallPolygon(planes, k, low, high) {
    const {normal, offset} = planes[k], middle = low.clone().add(high).multiplyScalar(0.5), size = high.distanceTo(low);
    const centre = middle.clone().addScaledVector(normal, offset - normal.dot(middle));
    const along = new THREE.Vector3(...(Math.abs(normal.x) < 0.6 ? [1, 0, 0] : [0, 1, 0])).cross(normal).normalize();
    const across = normal.clone().cross(along);
    let polygon = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) =>
        centre.clone().addScaledVector(along, a * size).addScaledVector(across, b * size));
    for (const axis of [0, 1, 2]) {
        const unit = new THREE.Vector3().setComponent(axis, 1);
        polygon = clipped(clipped(polygon, unit, low.getComponent(axis)), unit.clone().negate(), -high.getComponent(axis));
    }
    planes.forEach((plane, j) => { if (j !== k) polygon = clipped(polygon, plane.normal, plane.offset - 1e-6 * size); });
    return polygon;
}

// ---- the scene -------------------------------------------------------------------------------------

class Drawing {
    constructor(stage, scene, changed) {
        this.shown = scene;
        this.turned = false;  // from where the bodies fit
        this.renderer = new THREE.WebGLRenderer({antialias: true});
        this.canvas = this.renderer.domElement;
        stage.append(this.canvas);
        this.scene = new THREE.Scene();
        this.camera = new THREE.PerspectiveCamera(30, 1, 0.1, 10);
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.addEventListener("change", changed);
        this.controls.addEventListener("start", () => { this.turned = true; });
        this.addLights();
        this.low = new THREE.Vector3().fromArray(scene.bounds.low);
        this.high = new THREE.Vector3().fromArray(scene.bounds.high);
        this.radius = Math.max(0.5 * this.high.distanceTo(this.low), 1e-9);
        this.addBodies();
        this.walls = new THREE.Group();
        this.scene.add(this.walls);
        const behind = {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4};  // their own rims
        this.wallMaterial = new THREE.MeshBasicMaterial(behind);
        this.holeMaterial = new THREE.MeshBasicMaterial({...behind, side: THREE.BackSide});
        this.lineMaterial = new THREE.LineBasicMaterial();
    }

    addLights() {
        this.sky = new THREE.HemisphereLight(0xffffff, 0x8c8c8c, 1.55);
        this.sky.position.set(0, 0, 1);
        this.scene.add(this.sky);
        const lamp = new THREE.DirectionalLight(0xffffff, 1.75);  // goes with the eye, from the upper left
        lamp.position.set(-0.7, 1.0, 1.0);
        this.camera.add(lamp, lamp.target);
        lamp.target.position.set(0, 0, -1);
        this.scene.add(this.camera);
    }

    /** Forms with as many instances as there are bodies of them. */
    addBodies() {
        const forms = new Map();
        this.pieces = this.shown.bodies.map(body => pieces(body.shape).map(({key, make, local}) => {
            if (!forms.has(key)) forms.set(key, {make, count: 0});
            const form = forms.get(key);
            ++form.count;
            return {form, local};
        }));
        this.forms = [...forms.values()];
        for (const form of this.forms) {
            form.mesh = new THREE.InstancedMesh(form.make(form.count), new THREE.MeshLambertMaterial(), form.count);
            form.mesh.frustumCulled = false;
            this.scene.add(form.mesh);
        }
    }

    resize(width, height, ratio) {
        this.renderer.setPixelRatio(Math.min(ratio, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / Math.max(height, 1);
        this.camera.updateProjectionMatrix();
        if (!this.turned) this.fit();
    }

    /** All bodies within the window, seen from the front, a little from above and from the side. */
    fit() {
        const middle = this.low.clone().add(this.high).multiplyScalar(0.5), towards = new THREE.Vector3(0.5, -1, 0.36).normalize();
        const half = Math.tan(THREE.MathUtils.degToRad(this.camera.fov) / 2), aspect = this.camera.aspect;
        // The nearest eye from which all corners of the room are seen.
        const right = new THREE.Vector3(0, 0, 1).cross(towards).normalize(), up = towards.clone().cross(right);
        let distance = 0;
        for (let k = 0; k < 8; ++k) {
            const corner = new THREE.Vector3(...[0, 1, 2].map(i => (k >> i & 1 ? this.high : this.low).getComponent(i))).sub(middle);
            const need = Math.max(Math.abs(corner.dot(right)) / (half * aspect), Math.abs(corner.dot(up)) / half);
            distance = Math.max(distance, corner.dot(towards) + 1.08 * need);
        }
        distance = Math.max(distance, 1.2 * this.radius);
        this.camera.near = 0.01 * this.radius;
        this.camera.far = distance + 60 * this.radius;
        this.camera.position.copy(middle).addScaledVector(towards, distance);
        this.camera.updateProjectionMatrix();
        this.controls.target.copy(middle);
        this.controls.minDistance = 0.05 * this.radius;
        this.controls.maxDistance = distance + 40 * this.radius;
        this.controls.update();
        this.turned = false;
    }

    // ---- a frame -----------------------------------------------------------------------------------

    draw(frame, colours) {
        this.scene.background = new THREE.Color(colours.sheet);
        this.wallMaterial.color.set(colours.wall);
        this.holeMaterial.color.set(colours.wall);
        this.lineMaterial.color.set(colours.rim);
        const pose = new THREE.Matrix4(), placed = new THREE.Matrix4(), colour = new THREE.Color();
        const place = new THREE.Vector3(), turn = new THREE.Quaternion(), one = new THREE.Vector3(1, 1, 1);
        for (const form of this.forms) form.mesh.count = 0;
        frame.members.forEach((body, i) => {
            if (this.pieces[body].length === 0) return;
            place.fromArray(frame.position, 3 * i);
            turn.fromArray(frame.rotation, 4 * i).normalize();
            pose.compose(place, turn, one);
            colour.set(colours.of(i));
            for (const {form: {mesh}, local} of this.pieces[body]) {
                mesh.setMatrixAt(mesh.count, placed.multiplyMatrices(pose, local));
                mesh.setColorAt(mesh.count++, colour);
            }
        });
        for (const {mesh} of this.forms) {
            mesh.visible = mesh.count > 0;
            mesh.instanceMatrix.needsUpdate = true;
            if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
        }
        this.placeWalls(frame);
        this.renderer.render(this.scene, this.camera);
    }

    /** Walls are made anew when one of them has moved. */
    placeWalls(frame) {
        const planes = [], holes = [];
        frame.members.forEach((body, i) => {
            const {shape} = this.shown.bodies[body];
            if (shape.kind !== "half_space" && shape.kind !== "hole") return;
            const place = new THREE.Vector3().fromArray(frame.position, 3 * i);
            const turn = new THREE.Quaternion().fromArray(frame.rotation, 4 * i).normalize();
            if (shape.kind === "half_space") {
                const normal = new THREE.Vector3(...shape.normal).applyQuaternion(turn);
                planes.push({normal, offset: shape.offset + normal.dot(place)});
            } else {
                holes.push({axis: new THREE.Vector3(...shape.axis).applyQuaternion(turn).normalize(), radius: shape.radius,
                            centre: new THREE.Vector3(...shape.centre).applyQuaternion(turn).add(place)});
            }
        });
        const now = JSON.stringify([planes, holes]);
        if (now === this.placed) return;
        this.placed = now;
        this.walls.traverse(one => one.geometry?.dispose());
        this.walls.clear();
        planes.forEach((_, k) => this.addPlane(planes, k));
        for (const hole of holes) this.addHole(hole, planes);
    }

    /** Seen from its outside alone, so that no wall hides what is in a box; its rim from everywhere. */
    addPlane(planes, k) {
        const margin = new THREE.Vector3(1, 1, 0.06).multiplyScalar(0.35 * this.radius);
        const polygon = wallPolygon(planes, k, this.low.clone().sub(margin), this.high.clone().add(margin));
        if (polygon.length < 3) return;
        const numbers = polygon.slice(2).flatMap((p, i) => [polygon[0], polygon[i + 1], p]).flatMap(p => p.toArray());
        const face = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(numbers, 3));
        this.walls.add(new THREE.Mesh(face, this.wallMaterial));
        this.walls.add(new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(polygon), this.lineMaterial));
    }

    addHole({axis, centre, radius}, planes) {
        const middle = this.low.clone().add(this.high).multiplyScalar(0.5);
        // As long as the room along the axis; a plane across ends it there.
        let [from, to] = [-1, 1].map(side => axis.dot(middle) + side * (0.5 * ["x", "y", "z"].reduce((sum, x) =>
            sum + Math.abs(axis[x]) * (this.high[x] - this.low[x]), 0)));
        for (const {normal, offset} of planes) {
            const slope = normal.dot(axis);
            if (slope > 0.999) from = Math.max(from, offset);
            if (slope < -0.999) to = Math.min(to, -offset);
        }
        const shift = (from + to) / 2 - axis.dot(centre), long = Math.max(to - from, 1e-6 * radius);
        const tube = new THREE.Group();
        tube.position.copy(centre).addScaledVector(axis, shift);
        tube.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis);
        tube.add(new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, long, 96, 1, true), this.holeMaterial));
        const rim = Array.from({length: 96}, (_, k) => new THREE.Vector3(radius * Math.cos(k * Math.PI / 48), 0, radius * Math.sin(k * Math.PI / 48)));
        for (const end of [-0.5, 0.5]) {
            const ring = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(rim), this.lineMaterial);
            ring.position.y = end * long;
            tube.add(ring);
        }
        this.walls.add(tube);
    }
}
