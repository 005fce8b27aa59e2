// The page: a sea in a canvas, its panel, and a link that holds every option.
//
// Each frame applies the settings, simulates, and draws the sea and the boat. The sky is baked in
// slices between frames; until then the view draws a plain sky. Tests and the console use
// `window.pelagicPage`.
import createPelagicView from './pelagic_view.js';
import {Boat, boatHull} from './boat.js';
import {Camera, followInput} from './camera.js';
import {allOptions, check, defaultSettings, groupOf} from './options.js';
import {Panel} from './panel.js';
import {DrawDetail, drawsInSoftware, headsetDetail} from './draw_detail.js';
import {readLink, writeLink} from './share_link.js';
import {offerVr} from './vr_button.js';

/** Duration of a slice of the sky, milliseconds of script. */
const sliceMs = 12;
/** Interval of the displayed hash, which takes a few milliseconds to compute. */
const hashEveryMs = 500;
/**
 * Exposure above that of the sky, which is for a white card, in stops; the page has no light meter.
 * The meter of `pelagic render` gives 1.7 stops at noon, 1.6 overcast, 1.3 in a storm, 1.4 by
 * moonlight and 0.4 in the golden hour.
 */
const meteredStops = 1.3;
/** Number of equal frames after which the image is drawn in full size. */
const framesToRest = 12;
/** Longest time between frames while the sky is baked. */
const longestRestMs = 1000;

const byId = id => document.getElementById(id);
const canvas = byId('sea');

function showProblem(line) {
  byId('problem').textContent = line;
  byId('problem').hidden = !line;
}

class Page {
  constructor(module) {
    this.module = module;
    this.tables = module.pageTables();
    this.timings = {slices: []};
    this.settings = this.settingsOfLink();
    this.camera = new Camera(this.settings);
    this.keys = followInput(canvas, this.camera);
    this.makeView();
    this.detail = new DrawDetail(drawsInSoftware(this.gl));
    this.panel = new Panel(byId('panel'), this.tables, changes => this.change(changes));
    this.connectButtons();
    this.show();
    addEventListener('hashchange', () => this.openLink());
    document.addEventListener('visibilitychange', () => { this.wasHidden = true; });
    offerVr(byId('enter-vr'), () => this.vrOptions(), isInVr => this.restForVr(isInVr), showProblem);
    this.requestFrame();
  }

  // Settings.

  settingsOfLink() {
    try {
      const settings = readLink(location.hash, this.module, this.tables);
      showProblem('');
      return settings;
    } catch (error) {
      showProblem(`This link is damaged: ${error.message}. Here is the default sea.`);
      return defaultSettings(this.tables);
    }
  }

  openLink() {
    const settings = this.settingsOfLink();
    this.camera.take(settings);
    this.take(settings);
    this.boatChanged = true;  // an image depends on its link alone
  }

  /** Applies choices of the user. If one is invalid, shows why and changes nothing. */
  change(changes) {
    const settings = {...this.currentSettings(), ...changes};
    const reason = check(settings, this.module, this.tables);
    showProblem(reason);
    if (reason) return this.panel.show(this.settings);
    if ('cameraFlies' in changes) this.camera.flies = changes.cameraFlies;
    this.take(settings);
  }

  /** \pre check(settings) is empty */
  take(settings) {
    const before = this.settings;
    this.settings = settings;
    const differs = group => allOptions(this.tables).some(option => option.group === group && before[option.name] !== settings[option.name]);
    this.seaChanged ||= differs('sea');
    this.lightChanged ||= differs('light');
    this.boatChanged ||= before.boat !== settings.boat;
    this.isStale = true;
    this.show();
  }

  show() {
    this.panel.show(this.settings);
    byId('pause').setAttribute('aria-pressed', this.settings.paused);
  }

  currentSettings() {
    return {...this.settings, ...this.camera.settings()};
  }

  /** Returns a link to the current image. */
  link() {
    const settings = this.currentSettings();
    settings.timeS = Number(settings.timeS.toFixed(3));
    this.settings.timeS = settings.timeS;  // the displayed time is that of the link
    const text = writeLink(settings, this.tables);
    return `${location.origin}${location.pathname}${text && '#'}${text}`;
  }

  // View.

  makeView() {
    const {quality, shading, boat} = this.settings;
    this.view = new this.module.SeaView({...groupOf(this.settings, this.tables, 'sea'), quality, shading, hull: boat ? boatHull() : null});
    this.gl = this.view.context;
    this.boat ??= new Boat(this.gl);
    this.view.setLight(this.metered());
    this.shownTimeS = undefined;
    this.bake();
  }

  /** Returns the light of the settings with the page's exposure. */
  metered() {
    const light = groupOf(this.settings, this.tables, 'light');
    return {...light, stops: Math.min(light.stops + meteredStops, 5)};
  }

  followSettings() {
    if (this.seaChanged) {
      this.view.setSea(groupOf(this.settings, this.tables, 'sea'));
      this.shownTimeS = undefined;
    }
    if (this.lightChanged) {
      this.view.setLight(this.metered());
      this.bake();
    }
    if (this.boatChanged) {
      this.view.setHull(this.settings.boat ? boatHull() : null);
      this.shownTimeS = undefined;
    }
    this.seaChanged = this.lightChanged = this.boatChanged = false;
  }

  /**
   * Bakes the sky in slices. Slices and frames have equal time: after a long frame, as of a
   * software driver, the next frame waits for as many slices.
   */
  bake() {
    if (this.isBaking) return;
    this.isBaking = true;
    const slice = () => {
      const began = performance.now();
      this.timings.firstSliceMs ??= began;
      const isDone = this.view.continueBaking(sliceMs);
      const ended = performance.now();
      this.timings.slices.push(ended - began);
      this.isBaking = !isDone;
      if (isDone) {
        this.timings.skyMs ??= ended;
        this.isStale = true;
        this.requestFrame();
      } else {
        if (ended - this.frameEndedAt >= Math.min(this.frameMs, longestRestMs)) this.requestFrame();
        setTimeout(slice, 0);
      }
    };
    this.startSlices = () => {
      this.startSlices = undefined;
      setTimeout(slice, 0);
    };
  }

  requestFrame() {
    if (this.isFrameRequested) return;
    this.isFrameRequested = true;
    requestAnimationFrame(now => this.frame(now));
  }

  /** Sets mesh, shading and the canvas's size, which is that of the window times the scale. */
  fit() {
    const {quality, shading} = this.settings;
    const isFull = this.settings.scale || this.restingFrames >= framesToRest;
    const detail = isFull ? {scale: this.settings.scale || 1, quality, shading} : this.detail.of(this.settings);
    this.setDetail(detail);
    const scale = detail.scale * devicePixelRatio;
    const width = Math.max(1, Math.round(canvas.clientWidth * scale)), height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
  }

  setDetail({quality, shading}) {
    const wanted = `${quality}, ${shading}`;
    if (this.wantedDetail !== wanted) this.view.setDetail({quality, shading});
    this.wantedDetail = wanted;
  }

  frame(now) {
    this.isFrameRequested = false;
    if (this.isInVr) return;
    // without a jump after a pause
    const passed = Math.min((now - (this.lastNow ?? now)) / 1000, 0.25);
    const sinceLast = now - (this.lastNow ?? now);
    this.lastNow = now;
    // Pages in the background receive no frames.
    if (!this.isBaking && !this.restingFrames && !this.wasHidden) this.detail.follow(sinceLast);
    this.wasHidden = document.hidden;
    this.advance(passed);
    this.camera.fly(this.keys, passed);
    this.fit();
    const {width, height} = canvas;
    const eye = {viewport: [0, 0, width, height], ...this.camera.matrices(width / height)};
    // An image of the same time and camera is not drawn again.
    const seen = [this.shownTimeS, canvas.clientWidth, canvas.clientHeight, ...eye.view].join();
    const rests = seen === this.seen && !this.isStale;
    this.restingFrames = rests ? this.restingFrames + 1 : 0;
    const detail = `${width}, ${this.wantedDetail}`;
    if (!rests || this.drawnDetail !== detail) this.draw(null, width, height, [eye]);
    this.seen = seen;
    this.drawnDetail = detail;
    this.isStale = false;
    this.showStatistics(now, sinceLast);
    // The next task begins after the driver has accepted this frame's calls.
    setTimeout(() => this.endFrame(now), 0);
  }

  endFrame(began) {
    this.frameEndedAt = performance.now();
    this.frameMs = this.frameEndedAt - began;
    this.timings.firstFrameMs ??= this.frameEndedAt;
    this.startSlices?.();
    if (!this.isBaking) this.requestFrame();
  }

  /** Simulates the sea of the settings, `passed` seconds later. */
  advance(passed) {
    this.followSettings();
    if (!this.settings.paused) this.settings.timeS += passed;
    if (this.shownTimeS === this.settings.timeS) return;
    this.shownTimeS = this.settings.timeS;
    this.hash = undefined;
    this.view.simulate(this.shownTimeS);
  }

  draw(framebuffer, width, height, eyes) {
    this.view.draw({framebuffer, width, height, eyes});
    this.drawBoat(framebuffer, eyes, [0, 0, 0]);
  }

  /** @param origin  position of the eyes' origin in the world */
  drawBoat(framebuffer, eyes, origin) {
    if (!this.settings.boat) return;
    const light = this.view.lightInfo();
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, framebuffer);
    for (const eye of eyes) this.boat.draw(eye, this.view.hullMatrix(), light, origin);
  }

  /** The floor of the room is 1.6 m below the camera, and at least 1 m above the rest level. */
  vrOptions() {
    const [x, y, z] = this.camera.eye;
    return {
      view: this.view,
      timeS: this.settings.timeS,
      origin: [x, Math.max(y - 1.6, 1), z],
      drawMore: (framebuffer, eyes, origin) => this.drawBoat(framebuffer, eyes, origin),
    };
  }

  restForVr(isInVr) {
    this.isInVr = isInVr;
    this.setDetail(isInVr ? headsetDetail(this.settings) : this.settings);
    this.shownTimeS = undefined;
    this.isStale = true;
    if (!isInVr) this.requestFrame();
  }

  showStatistics(now, sinceLast) {
    byId('time').textContent = this.shownTimeS.toFixed(this.settings.paused ? 3 : 1);
    if (this.hash === undefined && (this.settings.paused || !(now - this.hashedAt < hashEveryMs))) {
      this.hash = this.view.hash();
      this.hashedAt = now;
      byId('hash').value = this.hash;
    }
    byId('frame-time').textContent = `sea ${this.view.simulateMs().toFixed(1)} ms, frame ${sinceLast.toFixed(0)} ms, ${canvas.width} x ${canvas.height}`;
    const sky = this.view.hasSky() ? '' : 'baking the sky ...';
    if (byId('sky-state').textContent !== sky) byId('sky-state').textContent = sky;
  }

  // Buttons and keys.

  connectButtons() {
    const togglePanel = () => {
      const isShown = byId('panel').hidden;
      byId('panel').hidden = !isShown;
      byId('toggle-panel').setAttribute('aria-expanded', isShown);
    };
    if (innerWidth <= 640) togglePanel();
    const pause = () => this.change({paused: !this.settings.paused, timeS: this.settings.timeS});
    const toggleFullScreen = () => (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
    byId('toggle-panel').addEventListener('click', togglePanel);
    byId('pause').addEventListener('click', pause);
    byId('share').addEventListener('click', () => this.share());
    byId('full-screen').hidden = !document.fullscreenEnabled;
    byId('full-screen').addEventListener('click', toggleFullScreen);
    const actions = {KeyH: togglePanel, Space: pause, KeyG: toggleFullScreen};
    addEventListener('keydown', event => {
      if (event.repeat || event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input, select, button, summary')) return;
      actions[event.code]?.();
      if (event.code === 'Space') event.preventDefault();
    });
  }

  /** Writes the link to the address bar, and to the clipboard if the browser permits it. */
  async share() {
    const link = this.link();
    history.replaceState(null, '', link);
    const button = byId('share');
    button.textContent = await navigator.clipboard?.writeText(link).then(() => 'Link copied', () => undefined) ?? 'Link is in the address bar';
    setTimeout(() => { button.textContent = 'Share link'; }, 2000);
  }
}

try {
  window.pelagicPage = new Page(await createPelagicView({canvas}));
} catch (error) {
  showProblem(`The sea can't be drawn here: ${error.message ?? error}`);
  throw error;
}
