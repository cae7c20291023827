// A bead that swells or dries, by LENS and by the fully nonlinear model.
const BEAD_SECONDS = 8;
const MODELS = ["lens", "nonlinear"];
const MODEL_NAMES = { lens: "LENS", nonlinear: "nonlinear" };

class BeadExplorer extends Explorer {
  constructor() {
    super("explore-bead");
    this.cases = {};
    for (const [name, bead] of Object.entries(data.beads)) {
      const models = {};
      for (const [model, packed] of Object.entries(bead.models)) {
        models[model] = { ...packed, shape: packed.r.shape, r: unpack(packed.r), phi: unpack(packed.phi) };
      }
      this.cases[name] = { ...bead, models };
    }
    this.control("case").addEventListener("change", (event) => {
      this.pause();
      this.choose(event.target.value);
    });
    this.choose(this.control("case").value);
    this.canvas("disc", (...all) => this.drawDisc(...all));
    this.canvas("profile", (...all) => this.drawProfile(...all));
    this.canvas("course", (...all) => this.drawCourse(...all));
  }

  choose(name) {
    const bead = (this.bead = this.cases[name]);
    this.t = bead.models.lens.t;
    this.frame = Math.floor(this.t.length / 3);
    const lens = bead.models.lens;
    // a course that is stored densely at its start is read on a logarithmic axis
    this.logarithmic = this.t[Math.floor(this.t.length / 2)] < 0.2 * this.t[this.t.length - 1];
    const all = Object.values(bead.models);
    this.low = smallest(all.map((model) => smallest([smallest(model.phi), smallest(model.surface)])));
    this.high = largest(all.map((model) => largest([largest(model.phi), largest(model.surface)])));
    this.most = largest(all.map((model) => largest(model.radius)));
    const fresh = this.control("t").cloneNode();
    this.control("t").replaceWith(fresh);
    this.setTime = this.slider("t", this.t.length, this.frame, (i) => printed(this.t[i]), (i) => {
      this.frame = i;
      this.show();
    });
    const stops = MODELS.filter((model) => bead.models[model].stopped).map((model) => `${MODEL_NAMES[model]}: ${bead.models[model].stopped}.`);
    this.element.querySelector("[data-note]").textContent = stops.join(" ");
    this.lens = lens;
    this.show();
  }

  // The stored time of a model at this frame, or none after its run has stopped.
  index(model) {
    const { t, stopped } = this.bead.models[model];
    const now = this.t[this.frame];
    if (stopped && now > t[t.length - 1] * (1 + 1e-9)) return -1;
    const after = Math.min(place(t, now), t.length - 1);
    return after > 0 && now - t[after - 1] < t[after] - now ? after - 1 : after;
  }

  show() {
    for (const model of MODELS) {
      const index = this.index(model);
      for (const name of ["radius", "surface", "centre"]) {
        this.number(`${model}-${name}`, index < 0 ? "stopped" : printed(this.bead.models[model][name][index]));
      }
    }
    this.paint();
  }

  play() {
    const last = this.t.length - 1;
    let position = this.frame >= last ? 0 : this.frame;
    this.animate((seconds) => {
      position = Math.min(last, position + (still.matches ? (seconds ? last / 20 : 0) : (seconds / BEAD_SECONDS) * last));
      this.frame = Math.round(position);
      this.setTime(this.frame);
      this.show();
      return position < last;
    });
  }

  share(phi) {
    return Math.log(phi / this.low) / Math.log(this.high / this.low);
  }

  drawDisc(context, width, height) {
    const scale = Math.min(width / 2 - 12, height / 2 - 30) / this.most;
    const [x, y] = [width / 2, (height + 16) / 2];
    MODELS.forEach((model, side) => {
      const index = this.index(model);
      const [from, to] = side ? [-Math.PI / 2, Math.PI / 2] : [Math.PI / 2, (3 * Math.PI) / 2];
      if (index >= 0) {
        const { shape, r, phi, radius, surface } = this.bead.models[model];
        const [rs, phis] = [row(r, shape, index), row(phi, shape, index)];
        const ring = (outer, fraction) => {
          context.fillStyle = shade(this.share(fraction));
          context.beginPath();
          context.moveTo(x, y);
          context.arc(x, y, outer * scale, from, to);
          context.fill();
        };
        ring(radius[index], surface[index]);
        for (let i = rs.length - 1; i >= 0; i--) ring(i ? (rs[i] + rs[i - 1]) / 2 + (rs[i] - rs[i - 1]) / 2 : rs[i], phis[i]);
        context.beginPath();
        context.arc(x, y, radius[index] * scale, from, to);
        context.strokeStyle = themed("ink");
        context.lineWidth = 1.1;
        context.stroke();
      }
      context.beginPath();
      context.setLineDash([1.5, 4]);
      context.arc(x, y, this.bead.models[model].radius[0] * scale, from, to);
      context.strokeStyle = themed("soft");
      context.lineWidth = 1;
      context.stroke();
      context.setLineDash([]);
      words(context, index < 0 ? `${MODEL_NAMES[model]}, stopped` : MODEL_NAMES[model], side ? width - 4 : 4, height - 10, { colour: themed("ink"), align: side ? "right" : "left" });
    });
    line(context, { x: (value) => value, y: (value) => value }, [x, x], [y - this.most * scale, y + this.most * scale], { colour: themed("soft"), width: 0.8 });
    shadeBar(context, width / 2 - 60, 4, 80, printed(this.low, 2), printed(this.high, 2), "φ");
  }

  drawProfile(context, width, height) {
    const at = axes(context, width, height, {
      x: linear(0, 1.05 * this.most), y: linear(0, 1.08 * this.high), xLabel: "r/R_{dry}", yLabel: "polymer fraction φ",
    });
    clipped(context, at.box, () => {
      MODELS.forEach((model) => {
        const index = this.index(model);
        if (index < 0) return;
        const { shape, r, phi, radius, surface, centre } = this.bead.models[model];
        const xs = [0, ...row(r, shape, index), radius[index]];
        const ys = [centre[index], ...row(phi, shape, index), surface[index]];
        line(context, at, xs, ys, { colour: this.colour(model), width: 2.2, dash: model === "lens" ? [] : [7, 4] });
      });
    });
    this.key(context, at);
  }

  colour(model) {
    return isDark() ? { lens: "#5db1e8", nonlinear: "#f08a4b" }[model] : data.colours[model];
  }

  key(context, at) {
    MODELS.forEach((model, i) => words(context, `${i ? "– –" : "——"} ${MODEL_NAMES[model]}`, at.box.right - 8, at.box.top + 14 + 18 * i, { colour: this.colour(model), align: "right" }));
  }

  drawCourse(context, width, height) {
    const last = this.t[this.t.length - 1];
    const start = this.t.find((t) => t > 0);
    const x = this.logarithmic ? logarithmic(start, last) : linear(0, last);
    const at = axes(context, width, height, { x, y: linear(0, 1.08 * this.most), xLabel: "time t", yLabel: "radius a/R_{dry}" });
    clipped(context, at.box, () => {
      for (const model of MODELS) {
        const { t, radius } = this.bead.models[model];
        const first = this.logarithmic ? 1 : 0;
        line(context, at, t.slice(first), radius.slice(first), { colour: this.colour(model), width: 2, dash: model === "lens" ? [] : [7, 4] });
        const within = this.bead.models[model].front.map((r, i) => [t[i], r]).filter(([, r]) => r > 0);
        line(context, at, within.map(([now]) => now), within.map(([, r]) => r), { colour: this.colour(model), width: 1.2, dash: [2, 3] });
      }
      const now = Math.max(this.t[this.frame], x.from);
      line(context, at, [now, now], [0, 1.08 * this.most], { colour: themed("soft"), width: 1.2 });
      for (const model of MODELS) {
        const radii = this.bead.published[model] || [];
        radii.forEach((radius, i) => dot(context, at.x(this.bead.published_t[i]), at.y(radius), { colour: this.colour(model), fill: themed("paper"), size: 3.2, square: model !== "lens" }));
        const index = this.index(model);
        if (index >= 0) dot(context, at.x(now), at.y(this.bead.models[model].radius[index]), { colour: this.colour(model), size: 4 });
      }
    });
  }
}
