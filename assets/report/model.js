// The view of a model's report: the three drops of its doll, with skin, bodies and limits, to be played and turned. What it draws
// is in the element #data (src/report/doll_view.hpp says what is in it). Written for three.js of Debian, release 111.
(function () {
  'use strict';
  const data = JSON.parse(document.getElementById('data').textContent);
  const byId = (id) => document.getElementById(id);
  const canvas = byId('canvas');

  // Numbers -----------------------------------------------------------------------------------------------------------------
  function numbers(base64, Type) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return new Type(bytes.buffer);
  }
  const drops = data.drops.map((drop) => ({
    poses: drop.poses,
    bodies: numbers(drop.bodies, Float32Array),
    tracks: numbers(drop.tracks, Float32Array),
  }));
  const secondsOf = (drop) => (drop.poses - 1) * data.secondsAPose;

  const from = new THREE.Quaternion();
  const to = new THREE.Quaternion();
  /** Element `index` of `count` a pose, between two poses, into an object's position and quaternion. */
  function place(values, count, index, pose, share, last, object) {
    const a = (pose * count + index) * 7;
    const b = (Math.min(pose + 1, last) * count + index) * 7;
    object.position.set(
      values[a] + (values[b] - values[a]) * share,
      values[a + 1] + (values[b + 1] - values[a + 1]) * share,
      values[a + 2] + (values[b + 2] - values[a + 2]) * share);
    from.fromArray(values, a + 3);
    to.fromArray(values, b + 3);
    THREE.Quaternion.slerp(from, to, object.quaternion, share);
  }

  // The scene ---------------------------------------------------------------------------------------------------------------
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  } catch (failure) {
    byId('message').textContent = 'The view needs WebGL, which this browser does not give. The rest of the page does not.';
    for (const control of document.querySelectorAll('.view button, .view input')) control.disabled = true;
    return;
  }
  renderer.gammaOutput = true;
  renderer.gammaFactor = 2.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;

  const size = data.heightM;
  const fieldOfView = 35;
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(fieldOfView, 1, size * 0.02, size * 60);
  const sun = new THREE.DirectionalLight(0xfff4e6, 1.6);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.bias = -0.0006;
  sun.shadow.radius = 3;
  Object.assign(sun.shadow.camera, { left: -2 * size, right: 2 * size, top: 2 * size, bottom: -2 * size, near: 0.1, far: 12 * size });
  scene.add(sun, sun.target, new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.1));
  const ground = new THREE.Mesh(new THREE.PlaneBufferGeometry(200, 200), new THREE.ShadowMaterial({ opacity: 0.22, depthWrite: false }));
  ground.rotation.x = -Math.PI / 2;
  ground.receiveShadow = true;
  scene.add(ground);
  // Cell by cell: some rasterisers drop a line that reaches behind the eye.
  const gridGeometry = new THREE.BufferGeometry();
  {
    const cell = 0.28 * size;
    const half = 30;
    const points = [];
    for (let i = -half; i <= half; ++i) {
      for (let k = -half; k < half; ++k) points.push(i, 0, k, i, 0, k + 1, k, 0, i, k + 1, 0, i);
    }
    gridGeometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points, (p) => p * cell), 3));
  }
  let grid;
  function takeColors() {
    const style = getComputedStyle(document.documentElement);
    const colorOf = (name) => new THREE.Color(style.getPropertyValue(name).trim());
    const line = colorOf('--faint').convertSRGBToLinear();
    scene.background = colorOf('--stage');  // goes to the screen as it is, unlike what is shaded
    scene.fog = new THREE.Fog(colorOf('--stage').convertSRGBToLinear(), size * 3, size * 8);
    if (grid) scene.remove(grid);
    grid = new THREE.LineSegments(gridGeometry, new THREE.LineBasicMaterial({ color: line, transparent: true, opacity: 0.4, depthWrite: false }));
    grid.position.y = -0.002 * size;
    scene.add(grid);
    dirty = true;
  }
  let dirty = true;

  // The skin ----------------------------------------------------------------------------------------------------------------
  const trackCount = drops[0].tracks.length / (7 * drops[0].poses);
  const bones = [];
  for (let i = 0; i < trackCount; ++i) {
    const bone = new THREE.Bone();
    bones.push(bone);
    scene.add(bone);
  }
  // A track's frame takes the bind pose into the world: nothing is left for inverse bind matrices to do.
  const skeleton = new THREE.Skeleton(bones, bones.map(() => new THREE.Matrix4()));
  const textures = data.textures.map((uri) => {
    if (!uri) return null;
    const texture = new THREE.TextureLoader().load(uri, () => { dirty = true; });
    texture.encoding = THREE.sRGBEncoding;
    texture.flipY = false;
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.anisotropy = 4;
    return texture;
  });
  const skins = data.meshes.filter((mesh) => mesh.indices).map((mesh) => {
    const geometry = new THREE.BufferGeometry();
    const add = (name, Type, values, width, normalized) => geometry.setAttribute(name, new THREE.BufferAttribute(numbers(values, Type), width, normalized));
    add('position', Float32Array, mesh.positions, 3, false);
    add('normal', Int8Array, mesh.normals, 4, true);
    add('skinIndex', Uint16Array, mesh.tracks, 4, false);
    add('skinWeight', Uint8Array, mesh.weights, 4, true);
    if (mesh.uvs) add('uv', Float32Array, mesh.uvs, 2, false);
    geometry.setIndex(new THREE.BufferAttribute(numbers(mesh.indices, Uint32Array), 1));
    const [r, g, b, a] = mesh.color;
    const material = new THREE.MeshStandardMaterial({
      color: new THREE.Color(r, g, b),
      map: mesh.uvs ? textures[mesh.texture] || null : null,
      roughness: 0.75,
      metalness: 0,
      skinning: true,
      side: mesh.doubleSided ? THREE.DoubleSide : THREE.FrontSide,
      alphaTest: mesh.cutoff,
      transparent: mesh.blend,
      opacity: a,
    });
    const skin = new THREE.SkinnedMesh(geometry, material);
    skin.bind(skeleton, new THREE.Matrix4());
    skin.castShadow = true;
    skin.receiveShadow = true;
    skin.frustumCulled = false;
    skin.userData = { transparent: mesh.blend, opacity: a };
    scene.add(skin);
    return skin;
  });

  // The bodies --------------------------------------------------------------------------------------------------------------
  function shapeOf(body) {
    if (body.kind === 'box') return new THREE.BoxBufferGeometry(...body.halfExtents.map((half) => 2 * half));
    if (body.kind === 'hull') {
      const hull = new THREE.BufferGeometry();
      hull.setAttribute('position', new THREE.Float32BufferAttribute(body.triangles, 3));
      hull.computeVertexNormals();
      return hull;
    }
    if (body.kind === 'sphere') return new THREE.SphereBufferGeometry(body.radius, 28, 18);
    const outline = [];
    for (let i = 0; i <= 20; ++i) {
      const angle = -Math.PI / 2 + (Math.PI * i) / 20;
      const middle = i < 10 ? -body.halfLength : body.halfLength;
      if (i === 10) outline.push(new THREE.Vector2(body.radius, -body.halfLength));
      outline.push(new THREE.Vector2(Math.max(body.radius * Math.cos(angle), 1e-5), middle + body.radius * Math.sin(angle)));
    }
    return new THREE.LatheBufferGeometry(outline, 28);
  }
  const bodies = data.bodies.map((body, index) => {
    // Neighbours differ in hue; the golden ratio keeps any two apart.
    const color = new THREE.Color().setHSL((0.58 + index * 0.618034) % 1, 0.36, 0.58).convertSRGBToLinear();
    const material = new THREE.MeshStandardMaterial({ color, roughness: 0.6, metalness: 0 });
    const mesh = new THREE.Mesh(shapeOf(body), material);
    mesh.castShadow = true;
    for (const added of body.more) {
      const part = new THREE.Mesh(shapeOf(added), material);
      part.position.fromArray(added.place.p);
      part.quaternion.fromArray(added.place.q);
      part.castShadow = true;
      mesh.add(part);
    }
    scene.add(mesh);
    return mesh;
  });

  // The limits: an ellipse of directions, or a hinge's sector, with the present direction in it -------------------------------
  const arcSteps = 32;
  const segmentsEach = arcSteps + 9;
  const limitGeometry = new THREE.BufferGeometry();
  const limitPoints = new Float32Array(data.constraints.length * segmentsEach * 6);
  const limitColors = new Float32Array(limitPoints.length);
  limitGeometry.setAttribute('position', new THREE.BufferAttribute(limitPoints, 3));
  limitGeometry.setAttribute('color', new THREE.BufferAttribute(limitColors, 3));
  const limits = new THREE.LineSegments(limitGeometry, new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, depthTest: false, transparent: true, fog: false }));
  limits.frustumCulled = false;
  limits.renderOrder = 2;
  scene.add(limits);
  const inside = new THREE.Color(0x0aa2b5).convertSRGBToLinear();
  const outside = new THREE.Color(0xe0382e).convertSRGBToLinear();
  const present = new THREE.Color(0xf2a516).convertSRGBToLinear();

  function frameOf(body, frame, rotation, origin) {
    rotation.copy(body.quaternion).multiply(to.fromArray(frame.q));
    origin.fromArray(frame.p).applyQuaternion(body.quaternion).add(body.position);
  }
  const parentRotation = new THREE.Quaternion();
  const childRotation = new THREE.Quaternion();
  const anchor = new THREE.Vector3();
  const unused = new THREE.Vector3();
  const relative = new THREE.Quaternion();
  const axis = new THREE.Vector3();
  const turn = new THREE.Quaternion();

  /** Where the child's x axis points, turned by a rotation vector in the parent's frame. */
  function direction(x, y, z, out) {
    const angle = Math.hypot(x, y, z);
    turn.setFromAxisAngle(axis.set(x, y, z).divideScalar(angle || 1), angle);
    return out.set(1, 0, 0).applyQuaternion(turn).applyQuaternion(parentRotation);
  }

  /** Whether the relative rotation is past the limit, by more than a degree. */
  function isPast(constraint) {
    const slack = Math.PI / 180;
    const { x, y, z, w } = relative;
    const sign = w < 0 ? -1 : 1;
    if (constraint.hinge) {
      const angle = 2 * Math.atan2(sign * z, sign * w);
      return angle < constraint.hinge[0] - slack || angle > constraint.hinge[1] + slack;
    }
    const [swingY, swingZ, most] = constraint.cone;
    const twist = 2 * Math.atan2(sign * x, sign * w);
    const cosine = Math.cos(twist / 2);
    const sine = Math.sin(twist / 2);
    // swing = relative · twist⁻¹, with x = 0
    const sy = sign * (y * cosine - z * sine);
    const sz = sign * (z * cosine + y * sine);
    const sw = sign * (w * cosine + x * sine);
    const half = Math.hypot(sy, sz);
    const scale = half > 1e-9 ? (2 * Math.atan2(half, sw)) / half : 2;
    const filled = Math.hypot((sy * scale) / swingY, (sz * scale) / swingZ);
    return Math.abs(twist) > most + slack || (filled > 1 && half * scale * (1 - 1 / filled) > slack);
  }

  function drawLimits() {
    let at = 0;
    const point = new THREE.Vector3();
    const length = 0.085 * size;
    const line = (a, b, color) => {
      for (const [p, fade] of [[a, 1], [b, 1]]) {
        limitPoints.set([anchor.x + p.x * length, anchor.y + p.y * length, anchor.z + p.z * length], at);
        limitColors.set([color.r * fade, color.g * fade, color.b * fade], at);
        at += 3;
      }
    };
    const middle = new THREE.Vector3(0, 0, 0);
    const previous = new THREE.Vector3();
    for (const constraint of data.constraints) {
      frameOf(bodies[constraint.child], constraint.childFromFrame, childRotation, unused);
      frameOf(bodies[constraint.parent], constraint.parentFromFrame, parentRotation, anchor);
      relative.copy(parentRotation).conjugate().multiply(childRotation);
      const color = isPast(constraint) ? outside : inside;
      const edge = (share, out) => {
        if (constraint.hinge) return direction(0, 0, constraint.hinge[0] + (constraint.hinge[1] - constraint.hinge[0]) * share, out);
        const angle = 2 * Math.PI * share;
        return direction(0, constraint.cone[0] * Math.cos(angle), constraint.cone[1] * Math.sin(angle), out);
      };
      edge(0, previous);
      for (let i = 1; i <= arcSteps; ++i) {
        edge(i / arcSteps, point);
        line(previous, point, color);
        previous.copy(point);
      }
      for (let i = 0; i < 8; ++i) {
        if (constraint.hinge && i % 7 !== 0) line(middle, middle, color);
        else line(middle, edge(constraint.hinge ? i / 7 : i / 8, point), color);
      }
      line(middle, point.set(1.25, 0, 0).applyQuaternion(childRotation), present);
    }
    limitGeometry.attributes.position.needsUpdate = true;
    limitGeometry.attributes.color.needsUpdate = true;
  }

  // The eye: it goes along with the doll, smoothly, and as the same at a moment however one came there ------------------------
  function centresOf(drop) {
    const raw = [];
    for (let pose = 0; pose < drop.poses; ++pose) {
      const centre = new THREE.Vector3();
      for (let body = 0; body < bodies.length; ++body) {
        const i = (pose * bodies.length + body) * 7;
        centre.add(new THREE.Vector3(drop.bodies[i], drop.bodies[i + 1], drop.bodies[i + 2]));
      }
      raw.push(centre.divideScalar(bodies.length));
    }
    const reach = 10;
    return raw.map((_, pose) => {
      const mean = new THREE.Vector3();
      for (let i = -reach; i <= reach; ++i) mean.add(raw[Math.min(Math.max(pose + i, 0), raw.length - 1)]);
      return mean.divideScalar(2 * reach + 1);
    });
  }
  const centres = drops.map(centresOf);
  const orbit = { yaw: 0.55, pitch: 0.2, distance: 1, shift: new THREE.Vector3() };
  function aim(state) {
    const path = centres[state.drop];
    const a = path[state.pose];
    const target = a.clone().lerp(path[Math.min(state.pose + 1, path.length - 1)], state.share);
    // Nearer to the floor the picture keeps some of it.
    target.y = Math.max(target.y, 0.28 * size);
    sun.target.position.copy(target);
    sun.position.copy(target).add(new THREE.Vector3(2.2, 4.5, 2.6).multiplyScalar(size));
    target.add(orbit.shift);
    const narrow = Math.max(1, 1.05 / camera.aspect);
    // All of the skin has room however the figure turns about its middle, hoods and wings too.
    const whole = (1.03 * data.reachM) / Math.sin((fieldOfView * Math.PI) / 360);
    const distance = Math.max(2.05 * size, whole) * orbit.distance * narrow;
    camera.position.set(
      target.x + distance * Math.cos(orbit.pitch) * Math.sin(orbit.yaw),
      Math.max(target.y + distance * Math.sin(orbit.pitch), 0.03 * size),
      target.z + distance * Math.cos(orbit.pitch) * Math.cos(orbit.yaw));
    camera.lookAt(target);
  }

  // Time --------------------------------------------------------------------------------------------------------------------
  const state = { drop: 0, seconds: 0, pose: 0, share: 0, playing: false, speed: 1 };
  const play = byId('play');
  const scrub = byId('scrub');
  const charts = Array.from(document.querySelectorAll('.chart'));
  const still = secondsOf(drops[0]) === 0;

  function show() {
    const drop = drops[state.drop];
    const last = drop.poses - 1;
    const at = still ? 0 : Math.min(state.seconds / data.secondsAPose, last);
    state.pose = Math.floor(at);
    state.share = at - state.pose;
    bones.forEach((bone, i) => place(drop.tracks, trackCount, i, state.pose, state.share, last, bone));
    bodies.forEach((body, i) => place(drop.bodies, bodies.length, i, state.pose, state.share, last, body));
    byId('clock').textContent = state.seconds.toFixed(2) + ' s';
    scrub.value = still ? 0 : state.seconds / secondsOf(drop);
    for (const chart of charts) {
      const { left, right, seconds } = chart.dataset;
      const x = Number(left) + (Number(right) - Number(left)) * Math.min(state.seconds / Number(seconds), 1);
      const cursor = chart.querySelector('.cursor');
      cursor.setAttribute('x1', x);
      cursor.setAttribute('x2', x);
      cursor.style.visibility = 'visible';
    }
    dirty = true;
  }
  function seek(seconds) {
    state.seconds = Math.min(Math.max(seconds, 0), secondsOf(drops[state.drop]));
    show();
  }
  function setPlaying(playing) {
    state.playing = playing && !still;
    if (state.playing && state.seconds >= secondsOf(drops[state.drop]) - 1e-6) state.seconds = 0;
    play.textContent = state.playing ? 'Pause' : 'Play';
    play.setAttribute('aria-label', play.textContent);
  }

  // What the reader does ------------------------------------------------------------------------------------------------------
  play.addEventListener('click', () => setPlaying(!state.playing));
  scrub.addEventListener('input', () => { setPlaying(false); seek(Number(scrub.value) * secondsOf(drops[state.drop])); });
  canvas.addEventListener('keydown', (event) => {
    if (event.key === ' ') setPlaying(!state.playing);
    else if (event.key === 'ArrowRight') seek(state.seconds + data.secondsAPose);
    else if (event.key === 'ArrowLeft') seek(state.seconds - data.secondsAPose);
    else return;
    event.preventDefault();
  });
  for (const chart of charts) {
    chart.addEventListener('click', (event) => {
      const box = chart.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * chart.viewBox.baseVal.width;
      const { left, right, seconds } = chart.dataset;
      setPlaying(false);
      seek(((x - Number(left)) / (Number(right) - Number(left))) * Number(seconds));
    });
  }
  function choose(buttons, chosen) {
    for (const button of buttons) button.setAttribute('aria-pressed', String(button === chosen));
  }
  drops.forEach((drop, index) => {
    const button = document.createElement('button');
    button.textContent = still ? 'Bind pose' : 'Drop ' + (index + 1);
    button.setAttribute('aria-pressed', String(index === 0));
    button.addEventListener('click', () => {
      choose(byId('drops').children, button);
      state.drop = index;
      seek(state.seconds);
    });
    byId('drops').append(button);
  });
  for (const button of byId('speeds').children) {
    button.addEventListener('click', () => {
      choose(byId('speeds').children, button);
      state.speed = Number(button.dataset.speed);
    });
  }
  if (still) for (const control of [play, scrub, ...byId('speeds').children]) control.disabled = true;

  const switches = { skin: byId('showSkin'), bodies: byId('showBodies'), limits: byId('showLimits') };
  function takeSwitches() {
    const glass = switches.bodies.checked || switches.limits.checked;
    for (const skin of skins) {
      skin.visible = switches.skin.checked;
      skin.castShadow = !glass;
      skin.material.transparent = glass || skin.userData.transparent;
      skin.material.depthWrite = !glass;
      skin.material.opacity = (glass ? 0.32 : 1) * skin.userData.opacity;
    }
    for (const body of bodies) body.visible = switches.bodies.checked;
    limits.visible = switches.limits.checked;
    dirty = true;
  }
  for (const box of Object.values(switches)) box.addEventListener('change', takeSwitches);
  if (skins.length === 0) {
    switches.skin.checked = false;
    switches.skin.disabled = true;
    switches.bodies.checked = true;
  }

  canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('pointermove', (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    if (event.buttons === 1 && !event.shiftKey) {
      orbit.yaw -= event.movementX * 0.008;
      orbit.pitch = Math.min(Math.max(orbit.pitch + event.movementY * 0.006, -0.3), 1.5);
    } else if (event.buttons) {
      const metres = (2 * Math.tan((camera.fov * Math.PI) / 360) * camera.position.distanceTo(sun.target.position)) / canvas.clientHeight;
      orbit.shift.add(new THREE.Vector3(-event.movementX * metres, event.movementY * metres, 0).applyQuaternion(camera.quaternion));
    }
    dirty = true;
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    orbit.distance = Math.min(Math.max(orbit.distance * Math.exp(event.deltaY * 0.001), 0.15), 5);
    dirty = true;
  }, { passive: false });
  canvas.addEventListener('dblclick', () => {
    Object.assign(orbit, { yaw: 0.55, pitch: 0.2, distance: 1 });
    orbit.shift.set(0, 0, 0);
    dirty = true;
  });

  // Pictures ----------------------------------------------------------------------------------------------------------------
  function fit() {
    const { clientWidth, clientHeight } = canvas.parentElement;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    dirty = true;
  }
  window.addEventListener('resize', fit);
  const scheme = window.matchMedia('(prefers-color-scheme: dark)');
  if (scheme.addEventListener) scheme.addEventListener('change', takeColors);

  let before = null;
  function frame(now) {
    if (state.playing && before !== null) {
      seek(state.seconds + (Math.min(now - before, 100) / 1000) * state.speed);
      if (state.seconds >= secondsOf(drops[state.drop]) - 1e-6) setPlaying(false);
    }
    before = now;
    if (dirty) {
      dirty = false;
      aim(state);
      if (limits.visible) drawLimits();
      renderer.render(scene, camera);
    }
    requestAnimationFrame(frame);
  }
  takeColors();
  takeSwitches();
  fit();
  show();
  requestAnimationFrame(frame);
})();
