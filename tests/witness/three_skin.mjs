// Where three.js has the vertices of a baked .glb at moments of its animation: its own loader, mixer and skinning, without a
// picture (a texture would need a browser, so that the file is read without its textures).
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** The .glb without its materials, which are of no matter here. */
function bare(bytes) {
  const jsonLength = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + jsonLength).toString());
  for (const list of ['materials', 'textures', 'images', 'samplers']) delete json[list];
  for (const mesh of json.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const head = Buffer.alloc(20);
  head.writeUInt32LE(0x46546c67, 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + padded.length + bytes.length - 20 - jsonLength, 8);
  head.writeUInt32LE(padded.length, 12);
  head.writeUInt32LE(0x4e4f534a, 16);
  return Buffer.concat([head, padded, bytes.subarray(20 + jsonLength)]);
}

/** A list of meshes, each a list of [x, y, z], for each of the moments in seconds. */
export async function threeVertices(bytes, moments) {
  const file = bare(bytes);
  const buffer = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  const mixer = new THREE.AnimationMixer(gltf.scene);
  for (const clip of gltf.animations) {
    const action = mixer.clipAction(clip);
    action.setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  const meshes = [];
  gltf.scene.traverse((object) => { if (object.isMesh) meshes.push(object); });
  const point = new THREE.Vector3();
  return moments.map((seconds) => {
    mixer.setTime(seconds);
    gltf.scene.updateMatrixWorld(true);
    return meshes.map((mesh) => {
      if (mesh.isSkinnedMesh) mesh.skeleton.update();
      return Array.from({ length: mesh.geometry.attributes.position.count }, (_, i) => {
        mesh.getVertexPosition(i, point);
        return point.applyMatrix4(mesh.matrixWorld).toArray();
      });
    });
  });
}
