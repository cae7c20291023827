// A tube that collapses behind a pulse of heat, and the flow in its wall and its lumen.
const TUBE_SECONDS = 7; // of the whole course
const TUBE_CLOSE = 0.1; // of the close view, to either side of the front, in L
const TUBE_CELLS = ["Phi1", "U_outer", "V_g", "V"];

const nearest = (values, value) => values.reduce((best, each, i) => (Math.abs(each - value) < Math.abs(values[best] - value) ? i : best), 0);

// A tube's wall between its swollen radii, coloured by Phi_1 at Z, and as it was when swollen.
function drawWall(context, at, { Z, Phi1, Phi_inf, ends, radii }) {
  const xs = [ends[0], ...Z, ends[1]];
  const Phi = [Phi1[0], ...Phi1, Phi1[Phi1.length - 1]];
  const shrunk = Phi.map((value) => Math.cbrt(1 / value));
  const [outer, inner] = radii;
  for (const side of [1, -1]) {
    for (let i = 0; i + 1 < xs.length; i++) {
      const [left, right] = [at.x(xs[i]), at.x(xs[i + 1]) + 0.6];
      context.fillStyle = shade(((Phi[i] + Phi[i + 1]) / 2 - 1) / (Phi_inf - 1));
      context.beginPath();
      context.moveTo(left, at.y(side * outer * shrunk[i]));
      context.lineTo(right, at.y(side * outer * shrunk[i + 1]));
      context.lineTo(right, at.y(side * inner * shrunk[i + 1]));
      context.lineTo(left, at.y(side * inner * shrunk[i]));
      context.fill();
    }
    for (const edge of radii) {
      line(context, at, xs, shrunk.map((value) => side * edge * value), { colour: themed("ink"), width: 1.1 });
      line(context, at, ends, [side * edge, side * edge], { colour: themed("soft"), width: 1, dash: [1.5, 4] });
    }
  }
}

class TubeExplorer extends Explorer {
  constructor() {
    super("explore-tube");
    this.unpacked = {};
    const tubes = this.choose("printed");
    this.ell = place(tubes.ell, 0.5);
    this.frame = place(tubes.tau, 0.02);
    this.setWall = this.slider("ell", tubes.ell.length, this.ell, (i) => printed(this.tubes.ell[i]), (i) => {
      this.ell = i;
      this.show();
    });
    this.setTime = this.slider("tau", tubes.tau.length, this.frame, (i) => printed(this.tubes.tau[i]), (i) => {
      this.frame = i;
      this.show();
    });
    this.control("closure").addEventListener("change", (event) => {
      this.pause();
      const [ell, tau] = [this.tubes.ell[this.ell], this.tubes.tau[Math.round(this.frame)]];
      const { ell: walls, tau: times } = this.choose(event.target.value);
      this.ell = nearest(walls, ell);
      this.frame = nearest(times, tau);
      this.control("ell").max = walls.length - 1;
      this.control("tau").max = times.length - 1;
      this.setWall(this.ell);
      this.setTime(this.frame);
      this.show();
    });
    this.control("close").addEventListener("change", () => this.paint());
    this.canvas("section", (...all) => this.drawSection(...all));
    this.canvas("velocity", (...all) => this.drawVelocity(...all));
    this.show();
  }

  // The tubes of one closure.
  choose(closure) {
    const tubes = (this.tubes = data.tube[closure]);
    this.closure = closure;
    this.shape = tubes.Z.shape;
    this.end = 1.08 * largest(tubes.Z_C);
    this.cells = this.unpacked[closure] ??= Object.fromEntries(["Z", ...TUBE_CELLS].map((name) => [name, unpack(tubes[name])]));
    return tubes;
  }

  // The cells at this moment; between two stored times, linear in the square root of tau.
  now(name) {
    const at = (frame) => row(this.cells[name], this.shape, this.ell * this.shape[1] + frame);
    const before = Math.floor(this.frame);
    const share = this.frame - before;
    if (!share) return at(before);
    const [first, second] = [at(before), at(before + 1)];
    return first.map((value, i) => value + share * (second[i] - value));
  }

  front() {
    const { Z_C } = this.tubes;
    const before = Math.floor(this.frame);
    const share = this.frame - before;
    return share ? Z_C[before] + share * (Z_C[before + 1] - Z_C[before]) : Z_C[before];
  }

  // What is shown of the axis.
  range() {
    const front = this.front();
    return this.control("close").checked ? [front - TUBE_CLOSE, front + TUBE_CLOSE] : [0, this.end];
  }

  show() {
    const tubes = this.tubes;
    const [i, j] = [this.ell, Math.round(this.frame)];
    this.number("Z_C", printed(tubes.Z_C[j]));
    for (const name of ["Phi1_front", "A", "V_front", "V_far"]) {
      this.number(name, printed(tubes[name][i][j]));
    }
    this.paint();
  }

  play() {
    const tau = this.tubes.tau;
    const last = tau.length - 1;
    let root = Math.sqrt(this.frame >= last ? tau[0] : tau[Math.round(this.frame)]);
    this.animate((seconds) => {
      if (still.matches) this.frame = Math.min(last, Math.floor(this.frame >= last ? 0 : this.frame + (seconds ? 1 : 0)));
      else {
        root = Math.min(root + (seconds / TUBE_SECONDS) * Math.sqrt(tau[last]), Math.sqrt(tau[last]));
        const after = Math.max(1, place(tau, root * root));
        const [a, b] = [Math.sqrt(tau[after - 1]), Math.sqrt(tau[Math.min(after, last)])];
        this.frame = after > last ? last : after - 1 + (root - a) / (b - a);
      }
      this.setTime(Math.round(this.frame));
      this.show();
      return this.frame < last;
    });
  }

  drawSection(context, width, height) {
    const ell = this.tubes.ell[this.ell];
    const at = axes(context, width, height, {
      x: linear(...this.range()), y: linear(-1.14, 1.14), xLabel: "axial position Z = z/L", yLabel: "radius R = r/a₁", top: 26,
    });
    const Z = this.now("Z");
    const Phi1 = this.now("Phi1");
    const Phi_inf = this.tubes.Phi_inf[this.ell];
    const radius = (i) => Math.cbrt(1 / Phi1[i]);
    clipped(context, at.box, () => {
      const ends = [Math.min(0, this.range()[0]), Math.max(this.end, this.range()[1])];
      drawWall(context, at, { Z, Phi1, Phi_inf, ends, radii: [1, ell] });
      const front = at.x(this.front());
      line(context, at, [this.front(), this.front()], [-1.14, 1.14], { colour: data.colours.nonlinear, width: 1.4, dash: [6, 4] });
      words(context, "front", front + 5, at.box.top + 9, { colour: themed("ink") });
      this.arrows(context, at, Z, radius, ell);
    });
    shadeBar(context, Math.max(90, at.box.left + 30), 6, 110, "1", printed(Phi_inf), "polymer fraction Φ₁");
  }

  arrows(context, at, Z, radius, ell) {
    const sample = (values, z) => {
      const after = place(Z, z);
      if (after === 0) return values[0];
      if (after >= Z.length) return values[Z.length - 1];
      return values[after - 1] + ((z - Z[after - 1]) / (Z[after] - Z[after - 1])) * (values[after] - values[after - 1]);
    };
    const scaleZ = at.x(1) - at.x(0);
    const scaleR = at.y(0) - at.y(1);
    const [U, V_g, V] = ["U_outer", "V_g", "V"].map((name) => this.now(name));
    const R = Z.map((_, i) => radius(i));
    const front = at.x(this.front());
    const [from] = this.range();
    const places = (spacing) => {
      const found = [];
      for (let x = front - spacing / 2; x > at.box.left; x -= spacing) found.push(x);
      for (let x = front + spacing / 2; x < at.box.right; x += spacing) found.push(x);
      return found.filter((x) => x > at.x(0)).map((x) => [x, from + (x - at.box.left) / scaleZ]);
    };
    const wide = at.box.right - at.box.left;
    const wall = [];
    for (const [x, z] of places(Math.max(15, wide / 56))) {
      const [u, v, r] = [sample(U, z), sample(V_g, z), sample(R, z)];
      // U_g is linear across the wall, and vanishes in its middle
      for (const depth of [0.85, 0.3, -0.3, -0.85]) {
        const s = (1 + ell) / 2 + (depth * (1 - ell)) / 2;
        wall.push([x, s * r, v * scaleZ, -depth * u * scaleR]);
      }
    }
    const apart = Math.max(22, wide / 30);
    const lumen = places(apart).map(([x, z]) => [x, 0, sample(V, z) * scaleZ, 0]);
    for (const [kind, look, longest] of [
      [wall, { colour: "#ffffff", edge: "#000000", width: 1.2 }, 20],
      [lumen, { colour: themed("link"), width: 2 }, Math.min(46, 1.6 * apart)],
    ]) {
      const size = largest(kind.map(([, , dx, dy]) => Math.hypot(dx, dy)));
      if (!(size > 0)) continue;
      for (const [x, R, dx, dy] of kind) {
        if (Math.hypot(dx, dy) < 0.12 * size) continue;
        const [ax, ay] = [(dx / size) * longest, (dy / size) * longest];
        arrow(context, x, at.y(R), ax, ay, look);
        if (kind === wall) arrow(context, x, at.y(-R), ax, -ay, look);
      }
    }
  }

  drawVelocity(context, width, height) {
    const top = 1.25 * this.tubes.highest[this.ell];
    const bottom = -0.08 * top;
    const at = axes(context, width, height, {
      x: linear(...this.range()), y: linear(bottom, top), xLabel: "axial position Z = z/L", yLabel: "lumen velocity V",
    });
    const Z = this.now("Z");
    const extended = (values) => [values[0], ...values, values[values.length - 1]];
    const [start, end] = [Math.min(0, this.range()[0]), Math.max(this.end, this.range()[1])];
    const xs = [start, ...Z, end];
    clipped(context, at.box, () => {
      line(context, at, [start, end], [0, 0], { colour: themed("soft"), width: 1 });
      line(context, at, xs, extended(this.now("V")), { colour: themed("link"), width: 2 });
      line(context, at, [this.front(), this.front()], [bottom, top], { colour: data.colours.nonlinear, width: 1.4, dash: [6, 4] });
    });
    const x = at.box.right - 8;
    const said = this.closure === "printed" ? "as printed in eqn:lumen" : "water conserved";
    words(context, said, x, at.box.top + 14, { colour: themed("link"), align: "right" });
  }
}
