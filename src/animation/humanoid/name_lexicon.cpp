#include "animation/humanoid/name_lexicon.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>

namespace lutka::animation {
namespace {

struct Entry {
    Concept meaning;
    std::string_view words;  // separated by blanks
};

// One line a concept and language group. Words shorter than three letters match whole tokens only.
constexpr Entry kEntries[] = {
    {Concept::upper, "ust upper up uper upr uppr ober superior sup inner"},
    {Concept::lower, "alt lower low lo lwr down dn fore lowr unter inferior inf outer"},
    {Concept::leftSide,
     "sol left l lft lf lt izq izquierda izquierdo links linke linker gauche sinistra sinistro sx esquerda "
     "esquerdo hidari"},
    {Concept::rightSide,
     "sag right r rgt rt rht derecha derecho der rechts rechte rechter droite droit destra destro dx direita "
     "direito migi"},
    {Concept::noise,
     "joint jnt jt jnts bone bones bip biped valvebiped valve mixamorig mixamo rig skeleton skel sk base "
     "bend stretch def deform armature human humanoid character char cc actor avatar skin main bn bnd bind "
     "object node nodes rootjoint"},
    {Concept::root, "root master cog reference trajectory motion world origin global center centre"},
    {Concept::hips,
     "kalca hips pelvis pelvic cadera caderas becken huefte hufte bassin hanches bacino bacia anca quadril pelve "
     "lowertorso hipsbone koshi kosi"},
    {Concept::hip, "hip hanche"},
    {Concept::spine,
     "spine spin spina spinal back lowerback backbone vertebra lumbar columna columnavertebral "
     "wirbelsaeule wirbelsaule wirbel ruecken rucken rugge colonne colonna coluna espinha thoracic thorasic"},
    {Concept::abdomen,
     "bel abdomen waist belly stomach tummy abs abdominal bauch taille ventre vientre cintura addome barriga "
     "midriff"},
    {Concept::torso, "torso trunk tronco torse rumpf"},
    {Concept::body, "body cuerpo koerper koerpe korper corps corpo"},
    {Concept::chest,
     "gogus chest ribcage ribs rib thorax pecho brust brustkorb poitrine petto peito torax sternum breastbone mune"},
    {Concept::neck, "boyun neck cervical cuello hals cou collo pescoco nacken kubi"},
    {Concept::head, "kafa head skull cranium cabeza kopf schaedel tete testa cabeca noggin atama"},
    {Concept::clavicle,
     "clavicle clavical clav clavicule clavicula collar collarbone colar scapula shoulderblade "
     "schluesselbein clavicola clv"},
    {Concept::shoulder, "omuz shoulder shoulders hombro schulter epaule spalla ombro kata"},
    {Concept::arm, "kol arm brazo bras braccio braco ude"},
    {Concept::upperArm, "upperarm uparm uparms oberarm shldr humerus bicep biceps upperarms ueude ninoude"},
    {Concept::forearm,
     "forearm forearms lowerarm loarm lowarm antebrazo unterarm avantbras avambraccio antebraco radius ulna "
     "farm forarm shitaude sitaude maeude zenwan"},
    {Concept::elbow, "dirsek elbow elbows codo ellbogen ellenbogen coude gomito cotovelo hiji hizi"},
    {Concept::wrist, "bilek wrist wrists muneca handgelenk poignet polso pulso tekubi"},
    {Concept::hand, "el hand hands palm fist mano mao faust hnd kist kisti te"},
    {Concept::leg, "bacak leg legs pierna bein jambe gamba perna ashi asi"},
    {Concept::thigh, "uyluk thigh thighs femur upleg upperleg muslo oberschenkel cuisse coscia coxa thg momo futomomo"},
    {Concept::shin,
     "baldir shin shins calf calves crus tibia lowerleg lowleg loleg pantorrilla espinilla unterschenkel mollet "
     "polpaccio panturrilha canela downleg sune fukurahagi"},
    {Concept::knee, "diz knee knees rodilla knie genou ginocchio joelho hiza"},
    {Concept::ankle, "ankle ankles tobillo knoechel knochel fussgelenk cheville caviglia tornozelo ashikubi asikubi"},
    {Concept::foot, "ayak foot feet pie fuss pied piede pe"},
    {Concept::heel, "heel talon tacon ferse tallone kakato"},
    {Concept::toes, "toe toes toebase ball dedospie zehe zehen orteil orteils punta tsumasaki tumasaki"},
    {Concept::twist,
     "twist twst roll rolls tw corrective helper muscle fix volume adj adjust share part partial twistbone"},
    {Concept::control,
     "ik fk ikfk ctrl ctl control controller controls controle controlador controlo kontrolle pole poletarget poles "
     "target tgt mch org tweak "
     "effector handle goal tracker lookat aim orient constraint footsteps vis driver rotator pivot locator "
     "loc grp group offset snap camera light lamp assimp prerotation translation parent switch dummy nurbs"},
    {Concept::end, "end nub tip site endsite leaf null headtop toetip effectorend terminal"},
    {Concept::finger,
     "parmak finger fingers thumb thumbs index middle mid ring pinky pinkie little digit phalanx phalange metacarpal "
     "carpal knuckle knuckles indexfinger middlefinger ringfinger finger0 daumen zeigefinger mittelfinger "
     "ringfinger pulgar indice menique dedo doigt dito thumb1 bigtoe smalltoe palmfinger"},
    {Concept::face,
     "eye eyes eyeball eyeballs eyelid eyelids eyebrow eyebrows brow brows lid lids jaw chin mouth lip lips "
     "tongue nose nostril nostrils cheek cheeks ear ears teeth tooth face facial forehead temple masseter "
     "caninus lash lashes ojo auge auges mandible snout muzzle horn horns beard moustache mustache uppertooth "
     "pupil iris"},
    {Concept::hair, "hair hairs bang bangs pony ponytail braid braids fringe hat cap helmet hood headband crown halo"},
    {Concept::cloth,
     "skirt cape cloak coat dress sleeve sleeves cloth clothes scarf belt strap straps robe bag pouch tie "
     "ribbon apron jacket shirt pants tassel hem breast breasts boob boobs pec pecs pectoral bust butt "
     "buttock buttocks glute glutes groin genital genitals nipple"},
    {Concept::prop,
     "weapon sword gun rifle shield prop props attach attachment mount holder slot socket att knife bow arrow quiver "
     "gear wield wielditem staff axe hammer pistol bullet equip item backpack holster magic camerabone propjoint "
     "scabbard "
     "blade"},
    {Concept::creature,
     "tail tails wing wings hind hindleg hindlimb hindlimbs hoof paw paws foreleg frontleg fin fins feather feathers "
     "beak claw "
     "claws tentacle tentacles antenna antennae antennas feeler feelers proboscis stinger backleg front rear trunk2 "
     "withers fetlock mane crin crina criniere cauda rabo pata patas zampa pfote delantera delantero trasera trasero "
     "dianteira dianteiro traseira traseiro"},
};

std::unordered_map<std::string_view, Concept> makeIndex() {
    std::unordered_map<std::string_view, Concept> index;
    for (const Entry& entry : kEntries) {
        std::size_t begin = 0;
        while (begin < entry.words.size()) {
            const std::size_t end = std::min(entry.words.find(' ', begin), entry.words.size());
            index.emplace(entry.words.substr(begin, end - begin), entry.meaning);
            begin = end + 1;
        }
    }
    return index;
}

// Longest first, so that an ankle (足首) is not read as a foot and a neck.
constexpr std::array<std::pair<std::u32string_view, std::string_view>, 86> kCjk{{
    {U"キャンセル", "helper"},
    {U"スカート", "skirt"},
    {U"グルーブ", "root"},
    {U"センター", "root"},
    {U"全ての親", "root"},
    {U"手持骨", "prop"},
    {U"上半身", "torso"},
    {U"下半身", "pelvis"},
    {U"つま先", "toe"},
    {U"親指", "thumb"},
    {U"人指", "index"},
    {U"人差指", "index"},
    {U"中指", "middle"},
    {U"薬指", "ring"},
    {U"小指", "pinky"},
    {U"手首", "wrist"},
    {U"足首", "ankle"},
    {U"ひじ", "elbow"},
    {U"ひざ", "knee"},
    {U"ヒジ", "elbow"},
    {U"ヒザ", "knee"},
    {U"前髪", "hair"},
    {U"両目", "eye"},
    {U"ボーン", "bone"},
    {U"捩り", "twist"},
    {U"ダミー", "dummy"},
    {U"操作", "control"},
    {U"大腿", "thigh"},
    {U"小腿", "calf"},
    {U"前臂", "forearm"},
    {U"小臂", "forearm"},
    {U"上臂", "upperarm"},
    {U"大臂", "upperarm"},
    {U"锁骨", "clavicle"},
    {U"鎖骨", "clavicle"},
    {U"脊椎", "spine"},
    {U"骨盆", "pelvis"},
    {U"盆骨", "pelvis"},
    {U"脖子", "neck"},
    {U"手掌", "hand"},
    {U"手腕", "wrist"},
    {U"脚掌", "foot"},
    {U"脚趾", "toe"},
    {U"肩膀", "shoulder"},
    {U"膝盖", "knee"},
    {U"手指", "finger"},
    {U"ネクタイ", "tie"},
    {U"胸部", "chest"},
    {U"調整", "helper"},
    {U"補助", "helper"},
    {U"付与", "helper"},
    {U"足先", "toe"},
    {U"左", "left"},
    {U"右", "right"},
    {U"首", "neck"},
    {U"頭", "head"},
    {U"头", "head"},
    {U"肩", "shoulder"},
    {U"腕", "arm"},
    {U"肘", "elbow"},
    {U"膝", "knee"},
    {U"手", "hand"},
    {U"足", "leg"},
    {U"脚", "leg"},
    {U"腰", "waist"},
    {U"胸", "chest"},
    {U"腹", "belly"},
    {U"指", "finger"},
    {U"目", "eye"},
    {U"眉", "brow"},
    {U"舌", "tongue"},
    {U"髪", "hair"},
    {U"发", "hair"},
    {U"捩", "twist"},
    {U"捻", "twist"},
    {U"先", "tip"},
    {U"親", "parent"},
    {U"袖", "sleeve"},
    {U"裾", "hem"},
    {U"尾", "tail"},
    {U"翼", "wing"},
    {U"耳", "ear"},
    {U"歯", "teeth"},
    {U"顎", "jaw"},
    {U"鼻", "nose"},
    {U"口", "mouth"},
}};

}  // namespace

std::optional<Concept> conceptOf(std::string_view word) {
    static const std::unordered_map<std::string_view, Concept> index = makeIndex();
    const auto found = index.find(word);
    if (found == index.end()) return std::nullopt;
    return found->second;
}

std::span<const std::pair<std::u32string_view, std::string_view>> cjkWords() {
    return kCjk;
}

}  // namespace lutka::animation
