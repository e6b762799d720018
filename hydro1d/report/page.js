"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const floats = (text) => new Float32Array(bytes(text));
  const unpack = (packed) => {
    const raw = new Uint16Array(bytes(packed.data)), step = (packed.high - packed.low) / 65534;
    return Float64Array.from(raw, (n) => (n === 65535 ? NaN : packed.low + n * step));
  };
  const show = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(5))) : "–");

  function ticks(low, high, most) {
    const raw = (high - low) / most, power = Math.pow(10, Math.floor(Math.log10(raw)));
    const step = power * [1, 2, 5, 10].find((n) => n * power >= raw * 0.999);
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) found.push(k * step);
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const text = (v) => (Math.abs(v) >= 1e5 || (step < 1e-4) ? v.toExponential(1) : v.toFixed(Math.min(digits, 6)));
    return found.map((v) => [v, text(v)]);
  }

  // A line chart on a canvas: series {name, colour, dash, x, y}; drag selects a stretch, a double click shows all.
  class Chart {
    constructor(place, options) {
      this.options = options;
      this.series = [];
      this.zoom = null;
      this.pointer = null;
      this.box = document.createElement("div");
      this.box.className = "chart";
      this.canvas = document.createElement("canvas");
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", options.label);
      this.legend = document.createElement("div");
      this.legend.className = "legend";
      this.box.append(this.legend, this.canvas);
      place.append(this.box);
      this.canvas.addEventListener("pointermove", (event) => this.moved(event));
      this.canvas.addEventListener("pointerleave", () => this.left());
      this.canvas.addEventListener("pointerdown", (event) => this.pressed(event));
      this.canvas.addEventListener("pointerup", (event) => this.released(event));
      this.canvas.addEventListener("dblclick", () => this.ask(null));
      new ResizeObserver(() => this.draw()).observe(this.box);
    }

    limits() {
      const fixed = this.options.limits;
      const x = this.zoom || (fixed && fixed.x) || this.extent((s) => s.x, null);
      let y = fixed && fixed.y;
      if (!y) {
        y = this.extent((s) => s.y, this.zoom);
        if (!this.zoom && this.options.usual && y[1] > 4 * this.options.usual) y[1] = 1.5 * this.options.usual;
      }
      const pad = (y[1] - y[0]) * 0.05 || Math.abs(y[1]) * 0.1 || 1;
      return { x, y: [y[0] - pad, y[1] + pad] };
    }

    extent(pick, within) {
      let low = Infinity, high = -Infinity;
      for (const s of this.series) {
        const values = pick(s);
        for (let k = 0; k < values.length; k += 1) {
          if (within && (s.x[k] < within[0] || s.x[k] > within[1])) continue;
          if (values[k] < low) low = values[k];
          if (values[k] > high) high = values[k];
        }
      }
      return low <= high ? [low, high] : [0, 1];
    }

    draw() {
      const width = this.box.clientWidth, height = this.options.height || 210;
      if (!width) return;
      const ratio = window.devicePixelRatio || 1;
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
      this.canvas.style.height = height + "px";
      const pen = this.canvas.getContext("2d");
      pen.scale(ratio, ratio);
      const frame = { left: 76, right: width - 24, top: 8, bottom: height - (this.options.xlabel ? 42 : 24) };
      const { x, y } = this.limits();
      const toX = (v) => frame.left + ((v - x[0]) / (x[1] - x[0])) * (frame.right - frame.left);
      const toY = (v) => frame.bottom - ((v - y[0]) / (y[1] - y[0])) * (frame.bottom - frame.top);
      this.scale = { frame, x, y, toX, toY };
      this.axes(pen, frame, x, y, toX, toY, height);
      pen.save();
      pen.beginPath();
      pen.rect(frame.left, frame.top - 2, frame.right - frame.left, frame.bottom - frame.top + 4);
      pen.clip();
      for (const s of this.series) this.line(pen, s, toX, toY);
      this.marks(pen, frame, toX, toY);
      pen.restore();
    }

    axes(pen, frame, x, y, toX, toY, height) {
      pen.font = "12px system-ui, sans-serif";
      [pen.strokeStyle, pen.fillStyle, pen.lineWidth] = ["#e4e6e9", "#444", 1];
      pen.textAlign = "center";
      pen.beginPath();
      for (const [value, text] of ticks(x[0], x[1], 9)) {
        pen.moveTo(toX(value), frame.top);
        pen.lineTo(toX(value), frame.bottom);
        pen.fillText(text, toX(value), frame.bottom + 16);
      }
      pen.textAlign = "right";
      for (const [value, text] of ticks(y[0], y[1], 5)) {
        pen.moveTo(frame.left, toY(value));
        pen.lineTo(frame.right, toY(value));
        pen.fillText(text, frame.left - 6, toY(value) + 4);
      }
      pen.stroke();
      pen.strokeStyle = "#888";
      pen.strokeRect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
      pen.textAlign = "center";
      if (this.options.xlabel) pen.fillText(this.options.xlabel, 0.5 * (frame.left + frame.right), height - 8);
      pen.save();
      pen.translate(13, 0.5 * (frame.top + frame.bottom));
      pen.rotate(-Math.PI / 2);
      pen.fillText(this.options.label, 0, 0);
      pen.restore();
    }

    line(pen, s, toX, toY) {
      pen.strokeStyle = s.colour;
      pen.lineWidth = s.width || 1.5;
      pen.setLineDash(s.dash || []);
      pen.beginPath();
      let down = false;
      for (let k = 0; k < s.x.length; k += 1) {
        if (!(Number.isFinite(s.y[k]) && Number.isFinite(s.x[k]))) { down = false; continue; }
        if (down) pen.lineTo(toX(s.x[k]), toY(s.y[k]));
        else pen.moveTo(toX(s.x[k]), toY(s.y[k]));
        down = true;
      }
      pen.stroke();
      pen.setLineDash([]);
    }

    marks(pen, frame, toX, toY) {
      if (this.start !== undefined && this.pointer !== null) {
        pen.fillStyle = "rgba(0, 114, 178, 0.15)";
        pen.fillRect(toX(this.start), frame.top, toX(this.pointer) - toX(this.start), frame.bottom - frame.top);
      }
      if (this.pointer === null) return this.write(null);
      [pen.strokeStyle, pen.lineWidth] = ["#999", 1];
      pen.beginPath();
      pen.moveTo(toX(this.pointer), frame.top);
      pen.lineTo(toX(this.pointer), frame.bottom);
      pen.stroke();
      const values = this.series.map((s) => {
        const k = this.nearest(s.x, this.pointer);
        if (k >= 0 && Number.isFinite(s.y[k])) {
          pen.fillStyle = s.colour;
          pen.beginPath();
          pen.arc(toX(s.x[k]), toY(s.y[k]), 3.2, 0, 7);
          pen.fill();
        }
        return k >= 0 ? s.y[k] : NaN;
      });
      this.write(values);
    }

    nearest(x, value) { // x rises
      let low = 0, high = x.length - 1;
      if (high < 0) return -1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (x[middle] <= value) low = middle; else high = middle;
      }
      return value - x[low] < x[high] - value ? low : high;
    }

    write(values) {
      const items = this.series.map((s, k) => {
        const item = document.createElement("span"), key = document.createElement("span");
        key.className = "key";
        key.style.borderTopColor = s.colour;
        key.style.borderTopStyle = s.dash ? "dashed" : "solid";
        item.append(key, s.name);
        if (values) {
          const value = document.createElement("b");
          value.textContent = " " + show(values[k]);
          item.append(value);
        }
        return item;
      });
      if (values) {
        const where = document.createElement("b");
        where.textContent = this.options.read + " = " + show(this.pointer);
        items.unshift(where);
      }
      this.legend.replaceChildren(...items);
    }

    at(event) {
      const { frame, x } = this.scale;
      const share = (event.offsetX - frame.left) / (frame.right - frame.left);
      return x[0] + Math.min(1, Math.max(0, share)) * (x[1] - x[0]);
    }

    moved(event) { this.point(this.at(event)); }
    left() { this.start = undefined; this.point(null); }
    pressed(event) { if (!this.options.still) this.start = this.at(event); }
    released(event) {
      const from = this.start, to = this.at(event);
      this.start = undefined;
      if (from !== undefined && Math.abs(this.scale.toX(from) - this.scale.toX(to)) > 6) {
        this.ask([Math.min(from, to), Math.max(from, to)]);
      } else this.draw();
    }
    point(value) { for (const chart of this.group || [this]) { chart.pointer = value; chart.draw(); } }
    ask(zoom) { for (const chart of this.group || [this]) { chart.zoom = zoom; chart.draw(); } }
  }

  function drawHistories() {
    const place = document.getElementById("histories"), found = data.histories;
    const charts = found.panels.map((panel) => {
      const chart = new Chart(place, { label: panel.label, xlabel: found.xlabel, read: "t", usual: panel.usual });
      chart.series = panel.series.map((s, k) => ({
        name: s.name, x: floats(s.x), y: floats(s.y), colour: data.palette[k % data.palette.length],
      }));
      return chart;
    });
    for (const chart of charts) { chart.group = charts; chart.draw(); }
    document.getElementById("whole").addEventListener("click", () => charts.length && charts[0].ask(null));
  }

  function drawProfiles() {
    const found = data.profiles, place = document.getElementById("profiles");
    const zones = floats(found.x), position = unpack(found.position), count = zones.length;
    const slider = document.getElementById("time"), clock = document.getElementById("clock");
    const frame = document.getElementById("frame"), play = document.getElementById("play");
    const panels = found.panels.map((panel) => ({ ...panel, all: unpack(panel.values) }));
    const theory = found.theory && {
      ...found.theory, at: unpack(found.theory.x), points: found.theory.x.shape[1],
      all: Object.fromEntries(Object.entries(found.theory.panels).map(([name, p]) => [name, unpack(p)])),
    };
    const charts = panels.map((panel) => new Chart(place, { label: panel.label, read: "X", still: true, height: 200 }));
    for (const chart of charts) chart.group = charts;

    function update() {
      const row = Number(slider.value), moving = frame.getAttribute("aria-pressed") === "true";
      const part = (values, width) => values.subarray(row * width, (row + 1) * width);
      const x = moving ? part(position, count) : zones;
      clock.textContent = "t = " + found.time[row].toPrecision(4) + " " + found.clock;
      charts.forEach((chart, k) => {
        const panel = panels[k];
        chart.options.xlabel = found.xlabel[moving ? "laboratory" : "lagrangian"];
        chart.options.read = moving ? "x" : "X";
        const across = moving ? [found.position.low, found.position.high] : [0, zones[count - 1] + zones[0]];
        chart.options.limits = { x: across, y: [panel.values.low, panel.values.high] };
        chart.series = [{ name: "calculated", x, y: part(panel.all, count), colour: data.palette[0], width: 1.8 }];
        const late = theory ? row - theory.first : -1;
        if (theory && !moving && late >= 0 && late < theory.count && theory.all[panel.name]) {
          const range = [late * theory.points, (late + 1) * theory.points];
          const y = theory.all[panel.name].subarray(...range);
          chart.series.push({ name: "theory", x: theory.at.subarray(...range), y, colour: "#000000", dash: [6, 4] });
        }
        chart.draw();
      });
    }
    let timer = null;
    play.addEventListener("click", () => {
      const stop = () => { clearInterval(timer); timer = null; play.textContent = "play"; };
      if (timer) return stop();
      play.textContent = "stop";
      if (Number(slider.value) >= Number(slider.max)) slider.value = 0;
      timer = setInterval(() => {
        if (Number(slider.value) >= Number(slider.max)) return stop();
        slider.value = Number(slider.value) + 1;
        update();
      }, 60);
      return null;
    });
    frame.addEventListener("click", () => {
      frame.setAttribute("aria-pressed", String(frame.getAttribute("aria-pressed") !== "true"));
      update();
    });
    slider.addEventListener("input", update);
    update();
  }

  function choosePictures() {
    const buttons = [...document.querySelectorAll("#pictures button")];
    for (const button of buttons) {
      button.addEventListener("click", () => {
        for (const other of buttons) {
          other.setAttribute("aria-pressed", String(other === button));
          document.getElementById(other.dataset.shows).hidden = other !== button;
        }
      });
    }
  }

  choosePictures();
  if (data.profiles) drawProfiles();
  drawHistories();
  document.documentElement.dataset.ready = "yes";
})();
